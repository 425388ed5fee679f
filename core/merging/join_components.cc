// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/join_components.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "core/base/random.h"
#include "core/estimators/estimate_absolute_pose.h"
#include "core/merging/find_common_view.h"
#include "core/merging/fit_seams.h"
#include "core/merging/merge_submodels.h"
#include "core/merging/quantile.h"

namespace orbweave {
namespace {

// Three rays make a pose; that five of a hundred more come within 4 sigmas (0.005 rad) of it by
// chance has odds of C(100, 5) (0.005^2 / 4)^5 = 5e-19.
constexpr int kMinPoints = 8;
constexpr double kMinShare = 0.25;
constexpr double kMaxErrorSigmas = 4.0;
constexpr size_t kMinLent = 3;

// A feature of an image sees a track of a component that the image is no part of.
struct SeenTrack {
  uint32_t track = 0;
  Observation observation{};
  friend bool operator<(const SeenTrack& x, const SeenTrack& y) {
    return std::tie(x.track, x.observation.ref) < std::tie(y.track, y.observation.ref);
  }
};

// By component and image of another component.
using Sights = std::map<std::pair<size_t, ImageId>, std::vector<SeenTrack>>;

class ComponentIndex {
 public:
  ComponentIndex(const std::vector<Reconstruction>& components, std::span<const ImageRays> images)
      : components_(components) {
    for (size_t c = 0; c < components.size(); ++c) {
      features_.push_back(IndexFeatures(components[c]));
      for (const auto& [id, image] : components[c].images) component_of_[id] = c;
    }
    for (const ImageRays& rays : images) rays_.emplace(rays.id, rays);
  }

  [[nodiscard]] std::optional<size_t> ComponentOf(ImageId image) const {
    const auto found = component_of_.find(image);
    return found == component_of_.end() ? std::nullopt : std::optional(found->second);
  }

  // Track of the image's component that holds the feature.
  [[nodiscard]] std::optional<uint32_t> TrackOf(size_t component, FeatureRef ref) const {
    const std::span<const TrackedFeature> features = FeaturesOf(features_[component], ref.image);
    const auto found = std::ranges::lower_bound(features, ref, {}, &TrackedFeature::ref);
    if (found == features.end() || found->ref != ref) return std::nullopt;
    return found->track;
  }

  [[nodiscard]] Observation ObservationOf(FeatureRef ref) const {
    const ImageRays& rays = rays_.at(ref.image);
    return {ref, rays.bearings[ref.feature], static_cast<double>(rays.sigma_rad[ref.feature])};
  }

 private:
  const std::vector<Reconstruction>& components_;
  std::vector<std::vector<TrackedFeature>> features_;
  std::map<ImageId, size_t> component_of_;
  std::map<ImageId, ImageRays> rays_;
};

Sights FindSights(const ComponentIndex& index, std::span<const TwoViewGeometry> pairs) {
  Sights sights;
  for (const TwoViewGeometry& pair : pairs) {
    const std::optional<size_t> of_a = index.ComponentOf(pair.pair.a);
    const std::optional<size_t> of_b = index.ComponentOf(pair.pair.b);
    if (!of_a || !of_b || *of_a == *of_b) continue;
    for (const FeatureMatch& match : pair.inliers) {
      const FeatureRef in_a{pair.pair.a, match.a};
      const FeatureRef in_b{pair.pair.b, match.b};
      if (const auto track = index.TrackOf(*of_a, in_a))
        sights[{*of_a, pair.pair.b}].push_back({*track, index.ObservationOf(in_b)});
      if (const auto track = index.TrackOf(*of_b, in_b))
        sights[{*of_b, pair.pair.a}].push_back({*track, index.ObservationOf(in_a)});
    }
  }
  // Several pairs may say the same; a track takes one feature of an image.
  for (auto& [key, seen] : sights) {
    std::sort(seen.begin(), seen.end());
    const auto repeated = std::ranges::unique(seen, {}, &SeenTrack::track);
    seen.erase(repeated.begin(), repeated.end());
  }
  return sights;
}

// An image of another component as this one sees it.
struct LentImage {
  size_t to = 0;
  size_t from = 0;
  ImageId image{};
  Rigid3 cam_from_world{};
  std::vector<SeenTrack> seen{};
};

absl::StatusOr<std::optional<LentImage>> Lend(const std::vector<Reconstruction>& components,
                                              size_t to,
                                              size_t from,
                                              ImageId image,
                                              const std::vector<SeenTrack>& seen,
                                              const StageContext& context) {
  if (seen.size() < static_cast<size_t>(kMinPoints)) return std::optional<LentImage>();
  std::vector<Eigen::Vector3d> bearings;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> sigmas;
  for (const SeenTrack& each : seen) {
    bearings.push_back(each.observation.bearing);
    points.push_back(components[to].tracks[each.track].point_in_world);
    sigmas.push_back(each.observation.sigma_rad);
  }
  StageContext own = context;
  own.seed = Random((uint64_t{to} << 32) | image.value).Next();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<AbsolutePose> pose,
                            EstimateAbsolutePose(bearings,
                                                 points,
                                                 kMaxErrorSigmas * Quantile(std::move(sigmas), 0.5),
                                                 {.min_inliers = kMinPoints},
                                                 own));
  if (!pose || pose->num_inliers < kMinShare * static_cast<double>(seen.size()))
    return std::optional<LentImage>();
  LentImage lent{.to = to, .from = from, .image = image, .cam_from_world = pose->cam_from_world};
  for (size_t i = 0; i < seen.size(); ++i) {
    if (pose->is_inlier[i] != 0) lent.seen.push_back(seen[i]);
  }
  return std::optional<LentImage>(std::move(lent));
}

// Images lent between components that lend each other enough of them.
absl::StatusOr<std::vector<LentImage>> LendImages(const std::vector<Reconstruction>& components,
                                                  const ComponentIndex& index,
                                                  const Sights& sights,
                                                  const StageContext& context) {
  std::vector<LentImage> lent;
  std::map<std::pair<size_t, size_t>, size_t> count;
  for (const auto& [key, seen] : sights) {
    const auto [to, image] = key;
    const size_t from = *index.ComponentOf(image);
    ORBWEAVE_ASSIGN_OR_RETURN(std::optional<LentImage> one,
                              Lend(components, to, from, image, seen, context));
    if (!one) continue;
    ++count[std::minmax(to, from)];
    lent.push_back(*std::move(one));
  }
  std::erase_if(lent, [&](const LentImage& each) {
    return count[std::minmax(each.to, each.from)] < kMinLent;
  });
  return lent;
}

void Take(const LentImage& lent, Reconstruction& component) {
  component.images[lent.image] = {.cam_from_world = lent.cam_from_world};
  for (const SeenTrack& seen : lent.seen) {
    std::vector<Observation>& observations = component.tracks[seen.track].observations;
    const auto place =
        std::ranges::lower_bound(observations, seen.observation.ref, {}, &Observation::ref);
    observations.insert(place, seen.observation);
  }
}

std::vector<Submodel> WithLent(const std::vector<Reconstruction>& components,
                               const std::vector<LentImage>& lent) {
  std::vector<Submodel> submodels;
  for (size_t c = 0; c < components.size(); ++c) {
    submodels.push_back({.component = static_cast<uint32_t>(c), .reconstruction = components[c]});
  }
  for (const LentImage& each : lent) Take(each, submodels[each.to].reconstruction);
  for (Submodel& submodel : submodels) submodel.reconstruction.SortTracks();
  return submodels;
}

}  // namespace

absl::StatusOr<std::vector<Reconstruction>> JoinComponents(std::vector<Reconstruction> components,
                                                           std::span<const ImageRays> images,
                                                           std::span<const TwoViewGeometry> pairs,
                                                           const AlignOptions& options,
                                                           const StageContext& context) {
  if (components.size() < 2) return components;
  const ComponentIndex index(components, images);
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<LentImage> lent,
                            LendImages(components, index, FindSights(index, pairs), context));
  if (lent.empty()) return components;
  const std::vector<Submodel> shared = WithLent(components, lent);
  ORBWEAVE_ASSIGN_OR_RETURN(const SeamsOfCluster seams,
                            FitSeams(shared, {}, options.max_error_px, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const Alignment alignment,
                            AlignSubmodels(std::span(&seams, 1), options, context));
  std::erase_if(lent, [&](const LentImage& each) {
    return alignment.world[each.to] != alignment.world[each.from];
  });
  if (lent.empty()) return components;
  std::vector<Reconstruction> joined;
  for (MergedWorld& world : MergeSubmodels(WithLent(components, lent), alignment))
    joined.push_back(std::move(world.reconstruction));
  return joined;
}

}  // namespace orbweave
