// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_standing_camera.h"

#include <cstdio>

namespace orbweave {
namespace {

constexpr double kNearlyAll = 0.9;

/// Of one image's verified pairs.
struct Pairs {
  uint32_t all = 0;
  uint32_t rotations = 0;
};

std::vector<Pairs> PairsOfImages(const JobResults& results) {
  std::vector<Pairs> pairs(results.manifest.images.size());
  const DividedViewGraph& graph = results.view_graph;
  for (size_t i = 0; i < graph.edges.size() && i < graph.edge_kinds.size(); ++i) {
    const bool is_rotation =
        graph.edge_kinds[i] == static_cast<uint8_t>(TwoViewKind::kPureRotation);
    for (const ImageId id : {graph.edges[i].a, graph.edges[i].b}) {
      if (id.value >= pairs.size()) continue;
      ++pairs[id.value].all;
      if (is_rotation) ++pairs[id.value].rotations;
    }
  }
  return pairs;
}

bool Stood(const Pairs& pairs) {
  return pairs.all > 0 && pairs.rotations >= kNearlyAll * static_cast<double>(pairs.all);
}

}  // namespace

std::vector<std::string> StandingReasons(const JobResults& results) {
  std::vector<std::string> reasons;
  for (const Pairs& pairs : PairsOfImages(results)) {
    std::string& reason = reasons.emplace_back();
    if (!Stood(pairs)) continue;
    reason = "the camera did not move: " + std::to_string(pairs.rotations) + " of its " +
             std::to_string(pairs.all) + " verified pairs are pure rotations, which give no depth";
  }
  return reasons;
}

std::optional<CrossCheck> CheckStandingCamera(const JobResults& results,
                                              std::span<const ReportImage> rows) {
  const std::vector<Pairs> pairs = PairsOfImages(results);
  size_t stood = 0;
  size_t left_out = 0;
  std::string first;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (!Stood(pairs[i])) continue;
    ++stood;
    if (rows[i].registered && !rows[i].loose) continue;
    if (left_out++ == 0) first = rows[i].name;
  }
  if (left_out == 0) return std::nullopt;
  char text[512];
  std::snprintf(
      text,
      sizeof text,
      "the camera did not move between %zu panoramas (first left out: %s): nearly all "
      "their verified pairs are pure rotations, from which nothing can be measured; take "
      "panoramas apart from each other by a twentieth of the distance to the scene or more",
      stood,
      first.c_str());
  return CrossCheck{.name = "standing_camera",
                    .value = static_cast<double>(left_out),
                    .unit = "count",
                    .level = CheckLevel::kDoubtful,
                    .sentence = text};
}

}  // namespace orbweave
