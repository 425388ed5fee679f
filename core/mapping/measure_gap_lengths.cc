// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/measure_gap_lengths.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "core/base/quantile.h"
#include "core/mapping/asked_rays.h"
#include "core/mapping/find_length_faults.h"
#include "core/mapping/ray_depths.h"

namespace orbweave {
namespace {

constexpr size_t kReach = 3;  // places from one image of a pair to the other

/// Registered images, drive by drive, in order of their ids.
class Sequence {
 public:
  explicit Sequence(const MappingState& state) : place_(state.Graph().NumImages()) {
    for (ImageSlot image = 0; image < state.Graph().NumImages(); ++image) {
      if (state.IsRegistered(image)) images_.push_back(image);
    }
    const auto& known = state.Problem().images;
    std::ranges::sort(images_, {}, [&](ImageSlot image) {
      return std::pair(known[image].drive, known[image].id);
    });
    for (size_t i = 0; i < images_.size(); ++i) place_[images_[i]] = i;
  }

  [[nodiscard]] size_t size() const { return images_.size(); }
  [[nodiscard]] ImageSlot At(size_t place) const { return images_[place]; }
  /// Of a registered image.
  [[nodiscard]] size_t PlaceOf(ImageSlot image) const { return place_[image]; }

 private:
  std::vector<ImageSlot> images_{};
  std::vector<size_t> place_;
};

/// A pair of a ray, seen from the image of the ray.
struct Sight {
  uint32_t pair = 0;  ///< of those asked
  size_t other = 0;   ///< place of the other image
  double log_depth = 0.0;
};

class GapCounts {
 public:
  explicit GapCounts(const AskedRays& asked)
      : state_(asked.state), asked_(asked), sequence_(asked.state), gaps_(sequence_.size()) {}

  /// `depths`: of one ray.
  void Add(std::span<const RayDepth> depths) {
    const ImageSlot own = state_.Graph().image_of_node[depths.front().node];
    const std::vector<Sight> sights = SightsOf(own, depths);
    const size_t here = sequence_.PlaceOf(own);
    for (const Sight& sight : sights) {
      const auto [first, last] = std::minmax(here, sight.other);
      if (last - first > kReach) continue;
      for (size_t gap = first; gap < last; ++gap) Ask(here, sight, gap, sights);
    }
  }

  /// Behind a place; nullopt where a drive ends.
  [[nodiscard]] std::optional<GapLength> Behind(size_t place) const {
    const ClusterImage& image = ImageAt(place);
    const ClusterImage& next = ImageAt(place + 1);
    if (image.drive != next.drive) return std::nullopt;
    const ImagePair between{image.id, next.id};
    const GapLength before = SumOf(between, gaps_[place].rays_before);
    const GapLength behind = SumOf(between, gaps_[place].rays_behind);
    return TellsLess(before, behind) ? behind : before;
  }

  [[nodiscard]] size_t NumPlaces() const { return sequence_.size(); }

 private:
  using RaysOfPairs = std::map<uint32_t, RayCount>;
  struct Gap {
    RaysOfPairs rays_before{};  ///< of images before it
    RaysOfPairs rays_behind{};
  };

  static GapLength SumOf(const ImagePair& between, const RaysOfPairs& rays) {
    GapLength sum{.between = between};
    for (const auto& [pair, count] : rays) {
      const LengthAgreement agreement = AgreementOf({count});
      sum.pairs += agreement.told > 0.0 ? 1 : 0;
      sum.agreement.Add(agreement);
    }
    return sum;
  }

  /// Whether one side is to be believed less: it tells too little, or agrees more.
  static bool TellsLess(const GapLength& one, const GapLength& other) {
    const bool is_enough = TellsEnough(one.agreement, one.pairs);
    if (is_enough != TellsEnough(other.agreement, other.pairs)) return !is_enough;
    return one.agreement.Share() > other.agreement.Share();
  }

  [[nodiscard]] const ClusterImage& ImageAt(size_t place) const {
    return state_.Problem().images[sequence_.At(place)];
  }

  /// Those with images of the same drive.
  [[nodiscard]] std::vector<Sight> SightsOf(ImageSlot own, std::span<const RayDepth> depths) const {
    std::vector<Sight> sights;
    for (const RayDepth& depth : depths) {
      const LinkedPair& pair = state_.Graph().pairs[asked_.pairs[depth.pair]];
      const ImageSlot other = pair.a == own ? pair.b : pair.a;
      if (state_.Problem().images[other].drive != state_.Problem().images[own].drive) continue;
      sights.push_back({depth.pair, sequence_.PlaceOf(other), depth.log_depth});
    }
    return sights;
  }

  /// What the pairs on this side of the gap say of one that leads across it.
  void Ask(size_t here, const Sight& across, size_t gap, std::span<const Sight> sights) {
    std::vector<double> reaches;
    for (const Sight& sight : sights) {
      if ((sight.other <= gap) == (here <= gap))
        reaches.push_back(asked_.log_lengths[sight.pair] + sight.log_depth);
    }
    if (reaches.empty()) return;
    const double told = Quantile(std::move(reaches), 0.5) - across.log_depth;
    RaysOfPairs& rays = here <= gap ? gaps_[gap].rays_before : gaps_[gap].rays_behind;
    rays[across.pair].Add(told, asked_.log_lengths[across.pair]);
  }

  const MappingState& state_;
  const AskedRays& asked_;
  Sequence sequence_;
  std::vector<Gap> gaps_;  ///< behind each place
};

}  // namespace

std::vector<GapLength> MeasureGapLengths(const AskedRays& asked) {
  GapCounts counts(asked);
  ForEachRay(asked.depths, [&](std::span<const RayDepth> ray) { counts.Add(ray); });
  std::vector<GapLength> gaps;
  for (size_t place = 0; place + 1 < counts.NumPlaces(); ++place) {
    if (const std::optional<GapLength> gap = counts.Behind(place)) gaps.push_back(*gap);
  }
  return gaps;
}

}  // namespace orbweave
