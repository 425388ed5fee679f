// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/drop_ghost_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/geometry/rotation.h"
#include "core/geometry/stands_between.h"
#include "core/mapping/model/filter_points.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMissed = 1.0 / 3.0;    // of what a third image should see
const double kBeside = std::cos(0.087);  // five degrees
constexpr double kAsFar = 0.15;          // difference of logarithms
constexpr double kInPlace = 2.0 / 3.0;   // of the share of what a third image sees

using Pair = std::pair<ImageSlot, ImageSlot>;

/// What two images see where a third stands between them.
struct SeenByTwo {
  std::vector<PointIndex> by_third{};
  std::vector<PointIndex> missed{};
};

/// Two images that see a point.
class Sight {
 public:
  Sight(const MappingState& state, const Vector3d& point, const Pair& pair)
      : state_(state),
        point_(point),
        one_(state.Centre(pair.first) - point),
        other_(state.Centre(pair.second) - point),
        two_{AngleBetween(one_, other_), std::max(one_.norm(), other_.norm())} {}

  /// Neither of the two stands between them itself.
  [[nodiscard]] bool HasBetween(ImageSlot third) const {
    const Vector3d from_point = state_.Centre(third) - point_;
    const double distance = from_point.norm();
    if (distance > kMaxFartherBetween * two_.farther) return false;  // most are, without angles
    return StandsBetween(
        two_, AngleBetween(one_, from_point), AngleBetween(other_, from_point), distance);
  }

 private:
  const MappingState& state_;
  const Vector3d point_;
  const Vector3d one_;
  const Vector3d other_;
  const TwoFromPoint two_;
};

/// Whether an image that has a verified pair with `image` stands between the two.
bool HasNeighbourBetween(const MappingState& state, ImageSlot image, const Sight& sight) {
  const CorrespondenceGraph& graph = state.Graph();
  return std::ranges::any_of(graph.pairs_of_image[image], [&](uint32_t p) {
    const ImageSlot third = graph.pairs[p].Other(image);
    return state.IsRegistered(third) && sight.HasBetween(third);
  });
}

/// By pair, the points that they see alone although an image that has verified pairs with one of
/// them stands between.
std::map<Pair, SeenByTwo> ListMissed(const MappingState& state) {
  std::map<Pair, SeenByTwo> seen;
  for (const PointIndex index : AllPoints(state)) {
    const MappedPoint& point = state.Point(index);
    if (point.nodes.size() != 2) continue;
    const std::vector<ImageSlot> images = ImagesThatSee(state, index);
    const Pair two{images[0], images[1]};
    const Sight sight(state, point.position, two);
    if (HasNeighbourBetween(state, two.first, sight) ||
        HasNeighbourBetween(state, two.second, sight))
      seen[two].missed.push_back(index);
  }
  return seen;
}

/// Adds what these pairs and a third image between them see.
void AddSeenByThird(const MappingState& state, std::map<Pair, SeenByTwo>& seen) {
  for (const PointIndex index : AllPoints(state)) {
    const MappedPoint& point = state.Point(index);
    if (point.nodes.size() < 3) continue;
    const std::vector<ImageSlot> images = ImagesThatSee(state, index);
    for (size_t i = 0; i < images.size(); ++i) {
      for (size_t k = i + 1; k < images.size(); ++k) {
        const auto pair = seen.find({images[i], images[k]});
        if (pair == seen.end()) continue;
        const Sight sight(state, point.position, pair->first);
        if (std::ranges::any_of(images, [&](ImageSlot third) { return sight.HasBetween(third); }))
          pair->second.by_third.push_back(index);
      }
    }
  }
}

/// Directions and distances of what an image sees with two others.
class Surroundings {
 public:
  Surroundings(const MappingState& state, ImageSlot image) : centre_(state.Centre(image)) {
    const CorrespondenceGraph& graph = state.Graph();
    for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
      const PointIndex point = state.PointOf(node);
      if (point == kNoPoint || state.Point(point).nodes.size() < 3) continue;
      const Vector3d away = state.Point(point).position - centre_;
      points_.push_back(point);
      directions_.push_back(away.normalized());
      distances_.push_back(away.norm());
    }
  }

  /// Whether a point is as far away as another beside it; nullopt: there is none.
  [[nodiscard]] std::optional<bool> HasAsFar(PointIndex point, const Vector3d& position) const {
    const Vector3d away = position - centre_;
    const Vector3d direction = away.normalized();
    std::optional<bool> has;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (points_[i] == point || directions_[i].dot(direction) < kBeside) continue;
      has = std::abs(std::log(distances_[i] / away.norm())) < kAsFar;
      if (*has) break;
    }
    return has;
  }

 private:
  Vector3d centre_;
  std::vector<PointIndex> points_{};
  std::vector<Vector3d> directions_{};
  std::vector<double> distances_{};
};

/// The surroundings of two images.
class BothSurroundings {
 public:
  BothSurroundings(const MappingState& state, const Pair& two)
      : state_(state), one_(state, two.first), other_(state, two.second) {}

  /// Of points of both images, the share that is as far away as others beside it; 1 where there is
  /// nothing beside any.
  [[nodiscard]] double ShareInPlace(std::span<const PointIndex> points) const {
    size_t asked = 0;
    size_t in_place = 0;
    for (const PointIndex point : points) {
      const Vector3d& position = state_.Point(point).position;
      const std::optional<bool> to_one = one_.HasAsFar(point, position);
      const std::optional<bool> to_other = other_.HasAsFar(point, position);
      if (!to_one && !to_other) continue;
      ++asked;
      if (to_one.value_or(true) && to_other.value_or(true)) ++in_place;
    }
    return asked == 0 ? 1.0 : static_cast<double>(in_place) / static_cast<double>(asked);
  }

 private:
  const MappingState& state_;
  const Surroundings one_;
  const Surroundings other_;
};

bool AreGhosts(const MappingState& state, const Pair& two, const SeenByTwo& seen) {
  const size_t all = seen.missed.size() + seen.by_third.size();
  if (static_cast<double>(seen.missed.size()) <= kMissed * static_cast<double>(all)) return false;
  const BothSurroundings around(state, two);
  return around.ShareInPlace(seen.missed) < kInPlace * around.ShareInPlace(seen.by_third);
}

}  // namespace

uint32_t DropGhostPoints(MappingState& state) {
  std::map<Pair, SeenByTwo> pairs = ListMissed(state);
  AddSeenByThird(state, pairs);
  std::vector<PointIndex> ghosts;
  for (const auto& [two, seen] : pairs) {
    if (!AreGhosts(state, two, seen)) continue;
    ghosts.insert(ghosts.end(), seen.missed.begin(), seen.missed.end());
  }
  for (const PointIndex point : ghosts) state.RemovePoint(point);
  return static_cast<uint32_t>(ghosts.size());
}

}  // namespace orbweave
