// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/misleading_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/geometry/angle_to_arc.h"
#include "core/geometry/rotation.h"
#include "core/mapping/model/registered_by_drive.h"
#include "core/mapping/registration/gnss_steps.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kBack_rad = 120.0 * kDegree_rad;
constexpr double kOnward_rad = 60.0 * kDegree_rad;
constexpr int kNeighbours = 2;
// Right pairs of ten metres and more were 0.05 to 1 degree off the model, 1.5 where they are weak.
constexpr double kTurnsOtherwise_rad = 2.0 * kDegree_rad;
constexpr double kTurnsAlike_rad = 0.75 * kDegree_rad;
constexpr double kLeadsAlike_rad = 2.0 * kDegree_rad;
constexpr double kLeadsOtherwise_rad = 4.0 * kDegree_rad;
constexpr double kSigmasOfGnss = 3.0;
constexpr double kHardlyParts = 0.25;   // of the angles of either way
constexpr size_t kTimesTheMatches = 2;  // the pair may have of those of either way

/// Whether three ways one after the other go on, and lead nowhere near a direction, however long
/// each is: what they make together lies in the cone about their middle that holds them all.
bool IsBeyond(const Vector3d& direction, const std::array<Vector3d, 3>& ways) {
  const Vector3d middle = ways[0] + ways[1] + ways[2];
  double cone_rad = 0.0;
  for (const Vector3d& way : ways) cone_rad = std::max(cone_rad, AngleBetween(way, middle));
  return cone_rad <= 0.5 * kOnward_rad &&
         AngleBetween(direction, middle) > cone_rad + kLeadsOtherwise_rad;
}

}  // namespace

MisleadingPairs::MisleadingPairs(const MappingState& state, std::vector<uint8_t> is_explained)
    : state_(state),
      is_explained_(std::move(is_explained)),
      sequence_(RegisteredByDrive(state)),
      place_(state.Graph().NumImages()) {
  for (size_t place = 0; place < sequence_.size(); ++place) place_[sequence_[place]] = place;
}

std::optional<ImageSlot> MisleadingPairs::At(ImageSlot image, int places_on) const {
  const auto place = static_cast<std::ptrdiff_t>(place_[image]) + places_on;
  if (place < 0 || place >= static_cast<std::ptrdiff_t>(sequence_.size())) return std::nullopt;
  const ImageSlot there = sequence_[static_cast<size_t>(place)];
  const std::vector<ClusterImage>& images = state_.Problem().images;
  return images[there].drive == images[image].drive ? std::optional(there) : std::nullopt;
}

const TwoViewGeometry& MisleadingPairs::GeometryOf(uint32_t pair) const {
  return state_.Problem().pairs[state_.Graph().pairs[pair].index];
}

bool MisleadingPairs::LeadsBack(uint32_t pair) const {
  const LinkedPair& link = state_.Graph().pairs[pair];
  if (!HasBaseline(GeometryOf(pair).kind)) return false;
  const bool is_forward = place_[link.a] < place_[link.b];
  const auto [first, last] = is_forward ? std::pair(link.a, link.b) : std::pair(link.b, link.a);
  if (At(first, 1) != last && At(first, kNeighbours) != last) return false;
  const Vector3d step = state_.Centre(last) - state_.Centre(first);
  if (AngleBetween(WayInWorld(pair, first), step) <= kBack_rad) return false;
  const std::optional<ImageSlot> before = At(first, -1);
  const std::optional<ImageSlot> behind = At(last, 1);
  const auto goes_on = [&](ImageSlot from, ImageSlot to) {
    return AngleBetween(state_.Centre(to) - state_.Centre(from), step) <= kOnward_rad;
  };
  return (before && goes_on(*before, first)) || (behind && goes_on(last, *behind));
}

double MisleadingPairs::TurnErrorOf(uint32_t pair) const {
  const LinkedPair& link = state_.Graph().pairs[pair];
  const Eigen::Quaterniond b_from_a =
      state_.CamFromWorld(link.b).rotation * state_.CamFromWorld(link.a).rotation.conjugate();
  const Eigen::Quaterniond& of_pair = GeometryOf(pair).b_from_a.rotation;
  return RotationAngle(of_pair.conjugate() * b_from_a);
}

bool MisleadingPairs::IsBorneOut(uint32_t pair, size_t min_matches) const {
  return is_explained_[pair] != 0 && GeometryOf(pair).inliers.size() >= min_matches &&
         TurnErrorOf(pair) <= kTurnsAlike_rad;
}

bool MisleadingPairs::LeadsAsModel(uint32_t pair, size_t min_matches) const {
  const LinkedPair& link = state_.Graph().pairs[pair];
  return HasBaseline(GeometryOf(pair).kind) && IsBorneOut(pair, min_matches) &&
         AngleBetween(WayInWorld(pair, link.a), state_.Centre(link.b) - state_.Centre(link.a)) <=
             kLeadsAlike_rad;
}

template <typename Counts>
std::map<ImageSlot, uint32_t> MisleadingPairs::PairsOf(ImageSlot image,
                                                       const Counts& counts) const {
  std::map<ImageSlot, uint32_t> pairs;
  for (const uint32_t p : state_.Graph().pairs_of_image[image]) {
    if (counts(p)) pairs.emplace(state_.Graph().pairs[p].Other(image), p);
  }
  return pairs;
}

template <typename Counts, typename SaysSo>
bool MisleadingPairs::AnyByWayOfThird(uint32_t pair,
                                      const Counts& counts,
                                      const SaysSo& says_so) const {
  const CorrespondenceGraph& graph = state_.Graph();
  const LinkedPair& link = graph.pairs[pair];
  const std::map<ImageSlot, uint32_t> pairs_to_third = PairsOf(link.a, counts);
  return std::ranges::any_of(graph.pairs_of_image[link.b], [&](uint32_t behind) {
    const auto before = pairs_to_third.find(graph.pairs[behind].Other(link.b));
    if (before == pairs_to_third.end() || !counts(behind)) return false;
    return says_so(before->second, before->first, behind);
  });
}

template <typename Counts, typename SaysSo>
bool MisleadingPairs::AnyByWayOfTwo(uint32_t pair,
                                    const Counts& counts,
                                    const SaysSo& says_so) const {
  const CorrespondenceGraph& graph = state_.Graph();
  const auto [first, last] = std::pair(graph.pairs[pair].a, graph.pairs[pair].b);
  const std::map<ImageSlot, uint32_t> pairs_to_last = PairsOf(last, counts);
  for (const auto& [second, to_second] : PairsOf(first, counts)) {
    for (const uint32_t onward : graph.pairs_of_image[second]) {
      const ImageSlot third = graph.pairs[onward].Other(second);
      const auto to_last = pairs_to_last.find(third);
      if (third == first || to_last == pairs_to_last.end() || !counts(onward)) continue;
      if (says_so(to_second, second, onward, third, to_last->second)) return true;
    }
  }
  return false;
}

bool MisleadingPairs::TurnsOtherwise(uint32_t pair) const {
  if (TurnErrorOf(pair) <= kTurnsOtherwise_rad) return false;
  const size_t matches = GeometryOf(pair).inliers.size();
  const auto counts = [&](uint32_t p) { return IsBorneOut(p, matches); };
  const auto any = [](auto... /*pairs and the images between*/) { return true; };
  return AnyByWayOfThird(pair, counts, any) || AnyByWayOfTwo(pair, counts, any);
}

bool MisleadingPairs::LeadsOtherwise(uint32_t pair) const {
  const TwoViewGeometry& geometry = GeometryOf(pair);
  if (!HasBaseline(geometry.kind)) return false;
  const auto [first, last] = std::pair(state_.Graph().pairs[pair].a, state_.Graph().pairs[pair].b);
  const Vector3d way = WayInWorld(pair, first).normalized();
  return AnyByWayOfThird(
      pair,
      [&](uint32_t p) { return LeadsAsModel(p, geometry.inliers.size()); },
      [&](uint32_t before, ImageSlot third, uint32_t behind) {
        const Vector3d to_third = WayInWorld(before, first).normalized();
        const Vector3d from_third = WayInWorld(behind, third).normalized();
        if (AngleBetween(to_third, -from_third) < kOnward_rad) return false;
        const auto [least, most] = SharesByGnss(first, third, last);
        const auto leads = [&](double share) -> Vector3d {
          return ((1.0 - share) * to_third + share * from_third).normalized();
        };
        return AngleToArc(way, leads(least), leads(most)) > kLeadsOtherwise_rad;
      });
}

bool MisleadingPairs::LeadsOtherwiseThanChain(uint32_t pair) const {
  const TwoViewGeometry& geometry = GeometryOf(pair);
  if (!HasBaseline(geometry.kind)) return false;
  const ImageSlot first = state_.Graph().pairs[pair].a;
  const Vector3d way = WayInWorld(pair, first).normalized();
  return AnyByWayOfTwo(
      pair,
      [&](uint32_t p) { return LeadsAsModel(p, geometry.inliers.size()); },
      [&](uint32_t to_second,
          ImageSlot second,
          uint32_t onward,
          ImageSlot third,
          uint32_t to_last) {
        return IsBeyond(way,
                        {WayInWorld(to_second, first).normalized(),
                         WayInWorld(onward, second).normalized(),
                         WayInWorld(to_last, third).normalized()});
      });
}

std::array<double, 2> MisleadingPairs::SharesByGnss(ImageSlot first,
                                                    ImageSlot third,
                                                    ImageSlot last) const {
  const GnssStep before = StepBetween(state_.Problem(), first, third);
  const GnssStep behind = StepBetween(state_.Problem(), third, last);
  const double log_ratio = behind.log_length - before.log_length;
  const double reach = kSigmasOfGnss * std::hypot(before.sigma, behind.sigma);
  const double in_model = std::log((state_.Centre(last) - state_.Centre(third)).norm() /
                                   (state_.Centre(third) - state_.Centre(first)).norm());
  if (!(std::abs(log_ratio - in_model) <= reach)) return {0.0, 1.0};
  const auto share = [](double log) { return 1.0 / (1.0 + std::exp(-log)); };
  return {share(log_ratio - reach), share(log_ratio + reach)};
}

Vector3d MisleadingPairs::WayInWorld(uint32_t pair, ImageSlot image) const {
  const LinkedPair& link = state_.Graph().pairs[pair];
  const Vector3d from_a_to_b =
      state_.CamFromWorld(link.a).rotation.conjugate() * GeometryOf(pair).b_from_a.Centre();
  return link.a == image ? from_a_to_b : Vector3d(-from_a_to_b);
}

bool MisleadingPairs::StandsStill(uint32_t pair) const {
  const TwoViewGeometry& geometry = GeometryOf(pair);
  const ImageSlot first = state_.Graph().pairs[pair].a;
  const auto moves_on = [&](uint32_t p) {
    const TwoViewGeometry& other = GeometryOf(p);
    return is_explained_[p] != 0 && HasBaseline(other.kind) &&
           kTimesTheMatches * other.inliers.size() >= geometry.inliers.size() &&
           geometry.median_angle_rad <= kHardlyParts * other.median_angle_rad;
  };
  return AnyByWayOfThird(pair, moves_on, [&](uint32_t before, ImageSlot third, uint32_t behind) {
    return AngleBetween(WayInWorld(before, first), WayInWorld(behind, third)) <= kOnward_rad;
  });
}

}  // namespace orbweave
