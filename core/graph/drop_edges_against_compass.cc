// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_compass.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/azimuth.h"

namespace orbweave {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kMaxSigmas = 4.0;
constexpr double kLeastLimit_deg = 20.0;
constexpr double kMostLimit_deg = 90.0;
constexpr size_t kFewestEdges = 10;
constexpr double kMinAgreeing = 0.75;

/// By how much an edge turns otherwise than headings say, and how much is too much.
struct Error {
  double error_deg = 0.0;
  bool is_too_large = false;
};

std::optional<Error> ErrorOf(const ViewEdge& edge, const ImageManifest& manifest) {
  const PosePrior& a = manifest.At(edge.pair.a).prior;
  const PosePrior& b = manifest.At(edge.pair.b).prior;
  if (edge.kind == TwoViewKind::kNone || !a.heading_deg || !b.heading_deg) return std::nullopt;
  const double stated_rad = kDegree_rad * (*a.heading_deg - *b.heading_deg);
  const double limit_deg =
      std::clamp(kMaxSigmas * std::hypot(a.heading_sigma_deg, b.heading_sigma_deg),
                 kLeastLimit_deg,
                 kMostLimit_deg);
  const double error_deg =
      AngleBetweenAzimuths(TurnOf(edge.b_from_a.rotation), stated_rad) / kDegree_rad;
  return Error{error_deg, error_deg > limit_deg};
}

using Drives = std::pair<uint32_t, uint32_t>;

Drives DrivesOf(const ViewEdge& edge, const ImageManifest& manifest) {
  return std::minmax(manifest.At(edge.pair.a).drive, manifest.At(edge.pair.b).drive);
}

struct Count {
  size_t edges = 0;
  size_t agreeing = 0;

  [[nodiscard]] bool IsBelieved() const {
    return edges >= kFewestEdges &&
           static_cast<double>(agreeing) >= kMinAgreeing * static_cast<double>(edges);
  }
};

}  // namespace

SiftedEdges DropEdgesAgainstCompass(const std::vector<ViewEdge>& edges,
                                    const ImageManifest& manifest) {
  std::vector<std::optional<Error>> errors;
  std::map<Drives, Count> counts;
  for (const ViewEdge& edge : edges) {
    errors.push_back(ErrorOf(edge, manifest));
    if (!errors.back()) continue;
    Count& count = counts[DrivesOf(edge, manifest)];
    ++count.edges;
    count.agreeing += errors.back()->is_too_large ? 0U : 1U;
  }
  return SiftEdges(edges, DropCause::kGnss, [&](uint32_t e) -> std::string {
    const std::optional<Error>& error = errors[e];
    if (!error || !error->is_too_large || !counts[DrivesOf(edges[e], manifest)].IsBelieved())
      return "";
    return "it turns by " + std::to_string(std::lround(error->error_deg)) +
           " degrees otherwise than the headings of its images";
  });
}

}  // namespace orbweave
