// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/order_along_way.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr size_t kFewestNearer = 3;
constexpr size_t kMostNearer = 20;
constexpr size_t kDisordered = 4;  // one of so many is not next to the next one
constexpr double kStanding = 0.1;  // of a usual step, as in UsualStep
constexpr size_t kSample = 500;
constexpr size_t kNeighbours = 6;
constexpr size_t kSides = 2;  // a place is joined to others on

/// The places but those where the camera stood.
std::vector<Eigen::Vector3d> MovingPlaces(std::span<const Eigen::Vector3d> places) {
  std::vector<double> steps;
  for (size_t i = 0; i + 1 < places.size(); ++i)
    steps.push_back((places[i + 1] - places[i]).norm());
  const double standing = kStanding * UsualStep(std::move(steps));
  std::vector<Eigen::Vector3d> moving;
  for (const Eigen::Vector3d& place : places) {
    if (moving.empty() || (place - moving.back()).norm() > standing) moving.push_back(place);
  }
  return moving;
}

/// A k-d tree over places, implicit in the order of their indices.
class PlaceTree {
 public:
  PlaceTree(std::span<const Eigen::Vector3d> places, std::vector<uint32_t> members)
      : places_(places), order_(std::move(members)), axis_(order_.size(), 0) {
    Divide(0, order_.size());
  }

  /// Those nearest to a place, itself left out, the nearest first; of equal ones the lower index.
  [[nodiscard]] std::vector<std::pair<double, uint32_t>> Nearest(uint32_t place) const {
    std::vector<std::pair<double, uint32_t>> found;
    Search(0, order_.size(), place, found);
    return found;
  }

 private:
  void Divide(size_t begin, size_t end) {
    if (end - begin < 2) return;
    Eigen::Vector3d low = places_[order_[begin]];
    Eigen::Vector3d high = low;
    for (size_t i = begin; i < end; ++i) {
      low = low.cwiseMin(places_[order_[i]]);
      high = high.cwiseMax(places_[order_[i]]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const size_t middle = (begin + end) / 2;
    const auto at = [&](size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
      return std::pair(places_[a][axis], a) < std::pair(places_[b][axis], b);
    });
    axis_[middle] = static_cast<uint8_t>(axis);
    Divide(begin, middle);
    Divide(middle + 1, end);
  }

  void Search(size_t begin,
              size_t end,
              uint32_t place,
              std::vector<std::pair<double, uint32_t>>& found) const {
    if (begin == end) return;
    const size_t middle = (begin + end) / 2;
    const uint32_t here = order_[middle];
    if (here != place) Offer({(places_[here] - places_[place]).norm(), here}, found);
    const double beyond = places_[place][axis_[middle]] - places_[here][axis_[middle]];
    const std::pair low{begin, middle};
    const std::pair high{middle + 1, end};
    const auto& [near, far] = beyond < 0.0 ? std::tie(low, high) : std::tie(high, low);
    Search(near.first, near.second, place, found);
    if (found.size() < kNeighbours || std::abs(beyond) <= found.back().first)
      Search(far.first, far.second, place, found);
  }

  static void Offer(const std::pair<double, uint32_t>& one,
                    std::vector<std::pair<double, uint32_t>>& found) {
    found.insert(std::ranges::upper_bound(found, one), one);
    if (found.size() > kNeighbours) found.pop_back();
  }

  std::span<const Eigen::Vector3d> places_;
  std::vector<uint32_t> order_;
  std::vector<uint8_t> axis_;
};

/// Places joined to paths.
class Paths {
 public:
  explicit Paths(size_t size) : joined_(size), piece_(size) {
    std::iota(piece_.begin(), piece_.end(), 0U);
  }

  /// False: one has two neighbours, or it would be a circle.
  bool Join(uint32_t a, uint32_t b) {
    const uint32_t piece_a = PieceOf(a);
    const uint32_t piece_b = PieceOf(b);
    if (joined_[a].size() >= kSides || joined_[b].size() >= kSides || piece_a == piece_b)
      return false;
    joined_[a].push_back(b);
    joined_[b].push_back(a);
    piece_[std::max(piece_a, piece_b)] = std::min(piece_a, piece_b);
    return true;
  }

  /// Places with fewer than two neighbours.
  [[nodiscard]] std::vector<uint32_t> Ends() const {
    std::vector<uint32_t> ends;
    for (uint32_t i = 0; i < joined_.size(); ++i) {
      if (joined_[i].size() < kSides) ends.push_back(i);
    }
    return ends;
  }

  /// From an end to the other.
  [[nodiscard]] std::vector<uint32_t> From(uint32_t end) const {
    std::vector<uint32_t> path = {end};
    for (std::optional<uint32_t> next = After(end, end); next;) {
      const uint32_t before = path.back();
      path.push_back(*next);
      next = After(*next, before);
    }
    return path;
  }

 private:
  uint32_t PieceOf(uint32_t place) {
    while (piece_[place] != place) place = piece_[place] = piece_[piece_[place]];
    return place;
  }
  [[nodiscard]] std::optional<uint32_t> After(uint32_t place, uint32_t before) const {
    for (const uint32_t next : joined_[place]) {
      if (next != before) return next;
    }
    return std::nullopt;
  }

  std::vector<std::vector<uint32_t>> joined_;
  std::vector<uint32_t> piece_;
};

/// Joins neighbours among `members`, the nearest first. Whether any were joined.
bool JoinNearest(std::span<const Eigen::Vector3d> places,
                 const std::vector<uint32_t>& members,
                 Paths& paths) {
  const PlaceTree tree(places, members);
  std::vector<std::tuple<double, uint32_t, uint32_t>> edges;
  for (const uint32_t a : members) {
    for (const auto& [distance, b] : tree.Nearest(a))
      edges.emplace_back(distance, std::min(a, b), std::max(a, b));
  }
  std::ranges::sort(edges);
  bool any = false;
  for (const auto& [distance, a, b] : edges) any = paths.Join(a, b) || any;
  return any;
}

}  // namespace

bool OrderVotes::AreInOrder() const { return kDisordered * against <= asked; }

OrderVotes VoteOnOrder(std::span<const Eigen::Vector3d> places) {
  const std::vector<Eigen::Vector3d> moving = MovingPlaces(places);
  OrderVotes votes;
  if (moving.size() < 2) return votes;
  const size_t many = std::clamp(moving.size() / 4, kFewestNearer, kMostNearer);
  const size_t steps = moving.size() - 1;
  for (size_t i = 0; i < steps; i += (steps + kSample - 1) / kSample) {
    const double step = (moving[i + 1] - moving[i]).squaredNorm();
    const auto within =
        static_cast<size_t>(std::ranges::count_if(moving, [&](const Eigen::Vector3d& place) {
          return (place - moving[i]).squaredNorm() < step;
        }));
    ++votes.asked;
    votes.against += within > many ? 1 : 0;  // it counts itself
  }
  return votes;
}

std::vector<uint32_t> OrderAlongWay(std::span<const Eigen::Vector3d> places) {
  if (places.empty()) return {};
  Paths paths(places.size());
  std::vector<uint32_t> ends = paths.Ends();
  while (ends.size() > 2 && JoinNearest(places, ends, paths)) ends = paths.Ends();
  std::vector<uint32_t> order;
  std::vector<uint8_t> is_taken(places.size(), 0);
  for (const uint32_t end : ends) {
    if (is_taken[end] != 0) continue;
    for (const uint32_t place : paths.From(end)) {
      is_taken[place] = 1;
      order.push_back(place);
    }
  }
  return order;
}

std::optional<std::vector<uint32_t>> OrderIfInNone(std::span<const Eigen::Vector3d> places) {
  if (VoteOnOrder(places).AreInOrder()) return std::nullopt;
  return OrderAlongWay(places);
}

}  // namespace orbweave
