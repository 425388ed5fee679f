// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_coverage.h"

#include <algorithm>
#include <map>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/graph/disjoint_sets.h"
#include "core/io/page/group_messages.h"
#include "core/report/share_check.h"

namespace orbweave {
namespace {

/// The images that verified pairs hold together.
DisjointSets PartsOfImages(size_t num_images, const std::vector<ImagePair>& edges) {
  DisjointSets parts(static_cast<uint32_t>(num_images));
  for (const ImagePair& edge : edges) {
    if (edge.a.value < num_images && edge.b.value < num_images)
      parts.Unite(edge.a.value, edge.b.value);
  }
  return parts;
}

}  // namespace

CrossCheck CheckRegistered(const JobReport& report) {
  const size_t total = report.images.size();
  const bool none = report.registered == 0;
  CrossCheck check = ShareCheck("images_registered",
                                report.registered,
                                std::max<size_t>(total, 1),
                                none ? CheckLevel::kBad : LevelOfShare(report.registered, total));
  check.sentence = none ? "no panorama could be registered"
                        : CountOf(report.registered, total, "panoramas are registered");
  if (check.level != CheckLevel::kGood && !report.not_registered.empty())
    check.sentence += "; left out: " + CommonestLine(report.not_registered);
  return check;
}

std::optional<CrossCheck> CheckFrames(const JobReport& report) {
  if (report.registered == 0) return std::nullopt;
  size_t on_earth = 0;
  size_t largest = 0;
  size_t frames = 0;
  size_t models_on_earth = 0;
  for (const ReportModel& model : report.each_model) {
    if (model.gnss.used) {
      frames += on_earth == 0 ? 1 : 0;
      on_earth += model.images;
      ++models_on_earth;
    } else {
      largest = std::max<size_t>(largest, model.images);
      ++frames;
    }
  }
  largest = std::max(largest, on_earth);
  CrossCheck check = ShareCheck(
      "images_in_one_frame", largest, report.registered, LevelOfShare(largest, report.registered));
  check.sentence =
      absl::StrCat(CountOf(largest, report.registered, "registered panoramas lie in one frame"));
  if (models_on_earth > 1)
    absl::StrAppend(&check.sentence, ", ", models_on_earth, " models joined by GNSS alone");
  if (check.level != CheckLevel::kGood) {
    absl::StrAppend(
        &check.sentence,
        ", the others in ",
        frames - 1,
        frames == 2 ? " frame of its own" : " frames of their own",
        ": nothing says where these models lie to each other, nor how large one is beside "
        "another; panoramas between them, "
        "or GNSS positions, would");
  }
  return check;
}

std::optional<CrossCheck> CheckConnected(const JobResults& results, const JobReport& report) {
  if (report.registered == 0) return std::nullopt;
  DisjointSets parts = PartsOfImages(report.images.size(), results.view_graph.edges);
  std::map<uint32_t, std::map<uint32_t, size_t>> images_of_part_and_model;
  for (uint32_t i = 0; i < report.images.size(); ++i) {
    const ReportImage& image = report.images[i];
    if (image.registered && !image.loose) ++images_of_part_and_model[parts.Find(i)][image.model];
  }
  size_t together = 0;
  size_t broken = 0;
  for (const auto& [number, models] : images_of_part_and_model) {
    size_t most = 0;
    for (const auto& [model, images] : models) most = std::max(most, images);
    together += most;
    broken += models.size() > 1 ? 1 : 0;
  }
  // How bad it is that they fell apart is for the check of frames to say.
  const CheckLevel level =
      std::min(LevelOfShare(together, report.registered), CheckLevel::kDoubtful);
  CrossCheck check = ShareCheck("connected_in_one_model", together, report.registered, level);
  check.sentence = CountOf(
      together, report.registered, "registered panoramas are in the main model of their part");
  if (level != CheckLevel::kGood) {
    absl::StrAppend(&check.sentence,
                    ": ",
                    broken,
                    broken == 1 ? " part" : " parts",
                    " of the street that verified pairs hold together fell into several models");
  }
  return check;
}

std::optional<CrossCheck> CheckUncertainty(const JobReport& report) {
  if (report.registered == 0) return std::nullopt;
  const auto known =
      static_cast<size_t>(std::ranges::count_if(report.images, [](const ReportImage& image) {
        return image.registered && !image.loose && image.uncertainty.has_value();
      }));
  const CheckLevel level = std::min(LevelOfShare(known, report.registered), CheckLevel::kDoubtful);
  CrossCheck check = ShareCheck("uncertainty_known", known, report.registered, level);
  check.sentence =
      CountOf(known, report.registered, "registered panoramas have a known uncertainty");
  if (level != CheckLevel::kGood) {
    absl::StrAppend(&check.sentence,
                    report.uncertainty.reason.empty() ? "" : ": ",
                    report.uncertainty.reason,
                    "; how far they may be off cannot be told");
  }
  return check;
}

}  // namespace orbweave
