// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_compass.h"

#include <Eigen/Geometry>
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
constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kAlike_deg = 20.0;
constexpr size_t kFewestOfImage = 3;

/// By how much an edge turns otherwise than headings say: as if the heading of its image b were so
/// much too large. And how much is too much.
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
  const double error_rad = std::remainder(TurnOf(edge.b_from_a.rotation) - stated_rad, kTurn_rad);
  return Error{error_rad / kDegree_rad, std::abs(error_rad) > limit_deg * kDegree_rad};
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

/// What the edges of an image with headings say of its own.
struct HeadingErrors {
  std::vector<double> errors_deg{};  ///< of each, as if it were this image's
  std::vector<ImageId> others{};     ///< to which each leads
  size_t agreeing = 0;
};

using ErrorsOfImages = std::map<ImageId, HeadingErrors>;

ErrorsOfImages ErrorsByImage(const std::vector<ViewEdge>& edges,
                             const std::vector<std::optional<Error>>& errors) {
  ErrorsOfImages of_images;
  for (size_t e = 0; e < edges.size(); ++e) {
    if (!errors[e]) continue;
    const auto [a, b] = std::pair(edges[e].pair.a, edges[e].pair.b);
    of_images[a].others.push_back(b);
    of_images[b].others.push_back(a);
    of_images[a].errors_deg.push_back(-errors[e]->error_deg);
    of_images[b].errors_deg.push_back(errors[e]->error_deg);
    if (errors[e]->is_too_large) continue;
    ++of_images[a].agreeing;
    ++of_images[b].agreeing;
  }
  return of_images;
}

double AngleBetween_deg(double a_deg, double b_deg) {
  return AngleBetweenAzimuths(a_deg * kDegree_rad, b_deg * kDegree_rad) / kDegree_rad;
}

/// Of azimuths that are about the same.
double MeanAzimuth_deg(const std::vector<double>& azimuths_deg) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const double azimuth_deg : azimuths_deg)
    sum += Eigen::Rotation2Dd(azimuth_deg * kDegree_rad) * Eigen::Vector2d::UnitX();
  return std::atan2(sum.y(), sum.x()) / kDegree_rad;
}

/// Whether the heading of an image is wrong rather than all its edges.
bool IsHeadingWrong(const HeadingErrors& image, const ErrorsOfImages& of_images) {
  const std::vector<double>& errors = image.errors_deg;
  if (errors.size() < kFewestOfImage) return false;
  const double mean_deg = MeanAzimuth_deg(errors);
  const double from_quarter_turn_deg = AngleBetween_deg(4.0 * mean_deg, 0.0) / 4.0;
  const bool are_alike = std::ranges::all_of(errors, [&](double error_deg) {
    return AngleBetween_deg(error_deg, mean_deg) <= kAlike_deg;
  });
  const bool lead_to_right_ones = std::ranges::all_of(
      image.others, [&](ImageId other) { return of_images.at(other).agreeing > 0; });
  return are_alike && lead_to_right_ones && from_quarter_turn_deg > kAlike_deg;
}

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
  const ErrorsOfImages of_images = ErrorsByImage(edges, errors);
  return SiftEdges(edges, DropCause::kGnss, [&](uint32_t e) -> std::string {
    const std::optional<Error>& error = errors[e];
    if (!error || !error->is_too_large || !counts[DrivesOf(edges[e], manifest)].IsBelieved() ||
        IsHeadingWrong(of_images.at(edges[e].pair.a), of_images) ||
        IsHeadingWrong(of_images.at(edges[e].pair.b), of_images))
      return "";
    return "it turns by " + std::to_string(std::lround(std::abs(error->error_deg))) +
           " degrees otherwise than the headings of its images";
  });
}

}  // namespace orbweave
