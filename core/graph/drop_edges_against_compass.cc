// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_compass.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
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
constexpr double kAlike_rad = 20.0 * kDegree_rad;
constexpr size_t kFewestOfImage = 3;

/// By how much an edge turns otherwise than headings say: as if the heading of its image b were so
/// much too large. And how much is too much.
struct Error {
  double error_rad = 0.0;
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
  const double error_rad = WrappedAzimuth(TurnOf(edge.b_from_a.rotation) - stated_rad);
  return Error{error_rad, std::abs(error_rad) > limit_deg * kDegree_rad};
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
  std::vector<double> errors_rad{};  ///< of each, as if it were this image's
  std::vector<ImageId> others{};     ///< to which each leads
  size_t agreeing = 0;
};

using ErrorsOfImages = std::map<ImageId, HeadingErrors>;

ErrorsOfImages ErrorsByImage(const std::vector<ViewEdge>& edges,
                             const std::vector<std::optional<Error>>& errors) {
  ErrorsOfImages of_images;
  const auto add = [&](ImageId image, ImageId other, double error_rad, bool agrees) {
    HeadingErrors& of_image = of_images[image];
    of_image.errors_rad.push_back(error_rad);
    of_image.others.push_back(other);
    of_image.agreeing += agrees ? 1 : 0;
  };
  for (size_t e = 0; e < edges.size(); ++e) {
    if (!errors[e]) continue;
    const bool agrees = !errors[e]->is_too_large;
    add(edges[e].pair.a, edges[e].pair.b, -errors[e]->error_rad, agrees);
    add(edges[e].pair.b, edges[e].pair.a, errors[e]->error_rad, agrees);
  }
  return of_images;
}

/// Of azimuths that are about the same.
double MeanAzimuth(const std::vector<double>& azimuths) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const double azimuth : azimuths)
    sum += Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
  return std::atan2(sum.y(), sum.x());
}

/// Whether the heading of an image is wrong rather than all its edges.
bool IsHeadingWrong(const HeadingErrors& image, const ErrorsOfImages& of_images) {
  if (image.errors_rad.size() < kFewestOfImage) return false;
  const double mean_rad = MeanAzimuth(image.errors_rad);
  const double from_quarter_turn_rad = AngleBetweenAzimuths(4.0 * mean_rad, 0.0) / 4.0;
  const bool are_alike = std::ranges::all_of(image.errors_rad, [&](double error_rad) {
    return AngleBetweenAzimuths(error_rad, mean_rad) <= kAlike_rad;
  });
  const bool lead_to_right_ones = std::ranges::all_of(
      image.others, [&](ImageId other) { return of_images.at(other).agreeing > 0; });
  return are_alike && lead_to_right_ones && from_quarter_turn_rad > kAlike_rad;
}

std::set<ImageId> WrongHeadings(const ErrorsOfImages& of_images) {
  std::set<ImageId> wrong;
  for (const auto& [image, errors] : of_images) {
    if (IsHeadingWrong(errors, of_images)) wrong.insert(image);
  }
  return wrong;
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
  const std::set<ImageId> wrong_headings = WrongHeadings(ErrorsByImage(edges, errors));
  return SiftEdges(edges, DropCause::kGnss, [&](uint32_t e) -> std::string {
    const std::optional<Error>& error = errors[e];
    if (!error || !error->is_too_large || !counts[DrivesOf(edges[e], manifest)].IsBelieved() ||
        wrong_headings.contains(edges[e].pair.a) || wrong_headings.contains(edges[e].pair.b))
      return "";
    return "it turns by " + std::to_string(std::lround(std::abs(error->error_rad) / kDegree_rad)) +
           " degrees otherwise than the headings of its images";
  });
}

}  // namespace orbweave
