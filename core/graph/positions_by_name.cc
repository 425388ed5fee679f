// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/positions_by_name.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "core/scene/captures_along.h"
#include "core/scene/folder_of.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

/// Of a run from which position the way to it comes, if from any.
struct Anchors {
  std::optional<size_t> before{};
  std::optional<size_t> behind{};
};

/// The images of one folder by id.
class NamedSequence {
 public:
  NamedSequence(std::vector<ImageId> images,
                const std::vector<uint8_t>& is_joined_to_next,
                ImageManifest& manifest)
      : images_(std::move(images)),
        captures_(CapturesAlong(manifest, images_)),
        is_joined_to_next_(is_joined_to_next),
        manifest_(manifest) {
    std::vector<const PosePrior*> priors;
    for (const ImageId image : images_) priors.push_back(&manifest_.At(image).prior);
    step_m_ = UsualStep(priors);
  }

  /// Each run between positions, or beside one.
  void PlaceRuns() {
    if (!(step_m_ > 0.0)) return;
    for (size_t first = 0; first < images_.size(); ++first) {
      if (HasPosition(first)) continue;
      size_t last = first;
      while (IsJoinedToNext(last) && !HasPosition(last + 1)) ++last;
      const Anchors anchors = AnchorsOf(first, last);
      for (size_t i = first; i <= last; ++i) Place(i, anchors);
      first = last;
    }
  }

 private:
  [[nodiscard]] PosePrior& PriorOf(size_t i) { return manifest_.images[images_[i].value].prior; }
  [[nodiscard]] bool HasPosition(size_t i) const {
    return manifest_.At(images_[i]).prior.position_in_enu.has_value();
  }

  [[nodiscard]] bool IsJoinedToNext(size_t i) const {
    return i + 1 < images_.size() && is_joined_to_next_[images_[i].value] != 0;
  }

  [[nodiscard]] Anchors AnchorsOf(size_t first, size_t last) const {
    Anchors anchors;
    if (first > 0 && IsJoinedToNext(first - 1)) anchors.before = first - 1;
    if (IsJoinedToNext(last)) anchors.behind = last + 1;
    return anchors;
  }

  void Place(size_t i, const Anchors& anchors) {
    if (anchors.before && anchors.behind) {
      PlaceBetween(i, *anchors.before, *anchors.behind);
    } else if (const std::optional<size_t> anchor =
                   anchors.before ? anchors.before : anchors.behind) {
      PlaceBeside(i, *anchor);
    }
  }

  [[nodiscard]] double CapturesBetween(size_t i, size_t j) const {
    return std::abs(static_cast<double>(captures_[j]) - static_cast<double>(captures_[i]));
  }

  void PlaceBetween(size_t i, size_t before, size_t behind) {
    const PosePrior& a = PriorOf(before);
    const PosePrior& b = PriorOf(behind);
    const double n = CapturesBetween(before, behind);
    const double k = CapturesBetween(before, i);
    const double way_m = n * step_m_;
    const double apart_m = DistanceBetween(a, b);
    const double past_m = 0.5 * std::sqrt(std::abs(way_m * way_m - apart_m * apart_m));
    const double spread_m = std::hypot(step_m_ * std::sqrt(k * (n - k) / n), past_m);
    PosePrior& prior = PriorOf(i);
    prior.position_in_enu = *a.position_in_enu + k / n * (*b.position_in_enu - *a.position_in_enu);
    prior.horizontal_sigma_m =
        std::hypot(std::max(a.horizontal_sigma_m, b.horizontal_sigma_m), spread_m);
    prior.vertical_sigma_m = std::hypot(std::max(a.vertical_sigma_m, b.vertical_sigma_m), spread_m);
  }

  void PlaceBeside(size_t i, size_t anchor) {
    const PosePrior& a = PriorOf(anchor);
    const double way_m = CapturesBetween(anchor, i) * step_m_;
    PosePrior& prior = PriorOf(i);
    prior.position_in_enu = a.position_in_enu;
    prior.horizontal_sigma_m = std::hypot(a.horizontal_sigma_m, way_m);
    prior.vertical_sigma_m = std::hypot(a.vertical_sigma_m, way_m);
  }

  std::vector<ImageId> images_;
  std::vector<uint32_t> captures_;
  const std::vector<uint8_t>& is_joined_to_next_;  ///< per image of the manifest
  ImageManifest& manifest_;
  double step_m_ = 0.0;
};

/// An edge to the next but one leads past the one between.
std::vector<uint8_t> JoinedToNext(const std::vector<ViewEdge>& edges, size_t num_images) {
  std::vector<uint8_t> is_joined(num_images, 0);
  for (const auto& edge : edges) {
    const auto [first, last] = std::pair(edge.pair.a.value, edge.pair.b.value);
    if (edge.kind == TwoViewKind::kNone || last - first > 2) continue;
    for (uint32_t i = first; i < last; ++i) is_joined[i] = 1;
  }
  return is_joined;
}

}  // namespace

void PlaceByName(const std::vector<ViewEdge>& edges, ImageManifest& manifest) {
  const std::vector<uint8_t> is_joined_to_next = JoinedToNext(edges, manifest.images.size());
  size_t first = 0;
  while (first < manifest.images.size()) {
    std::vector<ImageId> folder;
    const std::string_view name = FolderOf(manifest.images[first].name);
    for (; first < manifest.images.size() && FolderOf(manifest.images[first].name) == name; ++first)
      folder.push_back(manifest.images[first].id);
    NamedSequence(std::move(folder), is_joined_to_next, manifest).PlaceRuns();
  }
}

}  // namespace orbweave
