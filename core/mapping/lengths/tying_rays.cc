// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/tying_rays.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/ray_depths.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/lengths/street_lines.h"

namespace orbweave {
namespace {

/// More tell a step well enough.
constexpr uint32_t kManyTelling = 100;

/// Rays of another line that tie the images before a step, and those behind it.
struct TiesOfLine {
  uint32_t before = 0;
  uint32_t behind = 0;
};

class Counter {
 public:
  Counter(const AskedRays& asked, const std::set<ImageSlot>& steps)
      : asked_(asked),
        places_(asked.state, kMatchTolerance * asked.max_error_px),
        is_asked_(places_.size()),
        along_(places_.size()),
        by_line_(places_.size()) {
    for (size_t place = 0; place + 1 < places_.size(); ++place) {
      const Eigen::Vector3d step =
          asked.state.Centre(places_.At(place + 1)) - asked.state.Centre(places_.At(place));
      log_steps_.push_back(std::log(step.norm()));
      is_asked_[place] = steps.contains(places_.At(place)) ? 1 : 0;
    }
  }

  /// `depths`: of one ray.
  void Add(std::span<const RayDepth> depths) {
    if (depths.size() < 2) return;
    const ImageSlot own = asked_.state.Graph().image_of_node[depths.front().node];
    const size_t here = places_.PlaceOf(own);
    sights_.clear();
    for (const RayDepth& depth : depths) {
      const LinkedPair& pair = asked_.state.Graph().pairs[asked_.pairs[depth.pair]];
      const double log_length = asked_.log_lengths[depth.pair];
      sights_.push_back(
          {places_.PlaceOf(pair.Other(own)), log_length, log_length + depth.log_depth});
    }
    for (const Sight& sight : sights_) Tie(here, sight);
  }

  [[nodiscard]] std::map<ImageSlot, uint32_t> Take() const {
    std::map<ImageSlot, uint32_t> counts;
    for (size_t step = 0; step < along_.size(); ++step) {
      if (is_asked_[step] == 0) continue;
      uint32_t of_line = 0;
      for (const auto& [line, ties] : by_line_[step])
        of_line = std::max(of_line, std::min(ties.before, ties.behind));
      counts[places_.At(step)] = along_[step] + of_line;
    }
    return counts;
  }

 private:
  /// A pair of a ray, seen from the image of the ray.
  struct Sight {
    size_t other = 0;  ///< place of the other image
    double log_length = 0.0;
    double log_reach = 0.0;  ///< how far the ray reaches by it and by the model's length of it
  };

  [[nodiscard]] uint32_t LineAt(size_t place) const { return places_.LineOf(places_.At(place)); }

  /// The steps about the other image of a pair.
  void Tie(size_t here, const Sight& sight) {
    const bool is_same_line = LineAt(here) == LineAt(sight.other);
    const size_t apart = std::max(here, sight.other) - std::min(here, sight.other);
    if (is_same_line && apart <= kReachAlongLine) return;
    const size_t first = sight.other - std::min(sight.other, kReachAlongLine);
    const size_t last = std::min(sight.other + kReachAlongLine, log_steps_.size());
    for (size_t step = first; step < last; ++step) {
      if (is_asked_[step] == 0) continue;
      const bool is_behind = sight.other > step;
      if (LineAt(step) != LineAt(sight.other) || LineAt(step + 1) != LineAt(sight.other)) continue;
      if (sight.log_length > std::log(kMaxTie) + log_steps_[step]) continue;
      if (is_same_line && (here > step) == is_behind) continue;
      if (!IsBorneOut(here, sight, step)) continue;
      if (is_same_line) {
        ++along_[step];
      } else {
        TiesOfLine& ties = by_line_[step][LineAt(here)];
        ++(is_behind ? ties.behind : ties.before);
      }
    }
  }

  /// Whether pairs of the ray that stay in its line, and on its side of the step, have it reach as
  /// far; by their median.
  [[nodiscard]] bool IsBorneOut(size_t here, const Sight& asked, size_t step) {
    log_reaches_.clear();
    for (const Sight& sight : sights_) {
      if (LineAt(sight.other) != LineAt(here)) continue;
      const bool is_split = LineAt(here) == LineAt(step) && (sight.other > step) != (here > step);
      if (!is_split) log_reaches_.push_back(sight.log_reach);
    }
    const std::optional<double> reach = MedianReach(log_reaches_);
    return reach && std::abs(*reach - asked.log_reach) <= kCloseTolerance;
  }

  const AskedRays& asked_;
  RegisteredSequence places_;
  std::vector<double> log_steps_{};  ///< from each place to the next
  std::vector<uint8_t> is_asked_;    ///< the step behind each place
  std::vector<uint32_t> along_;      ///< of images further along the same line
  std::vector<std::map<uint32_t, TiesOfLine>> by_line_;
  // Of the ray at hand; kept for their memory.
  std::vector<Sight> sights_{};
  std::vector<double> log_reaches_{};
};

}  // namespace

std::map<ImageSlot, uint32_t> CountTyingRays(const AskedRays& asked,
                                             const std::set<ImageSlot>& steps) {
  if (steps.empty()) return {};
  Counter counter(asked, steps);
  ForEachRay(asked.depths, [&](std::span<const RayDepth> ray) { counter.Add(ray); });
  return counter.Take();
}

void AddTyingRays(const AskedRays& asked, std::span<GapLength> gaps) {
  const auto image_of = [&](const GapLength& gap) {
    return SlotOf(asked.state.Problem(), gap.between.a).value();
  };
  std::set<ImageSlot> steps;
  for (const GapLength& gap : gaps) {
    if (gap.telling_rays < kManyTelling) steps.insert(image_of(gap));
  }
  const std::map<ImageSlot, uint32_t> tying_rays = CountTyingRays(asked, steps);
  for (GapLength& gap : gaps) {
    if (const auto tying = tying_rays.find(image_of(gap)); tying != tying_rays.end())
      gap.telling_rays += tying->second;
  }
}

}  // namespace orbweave
