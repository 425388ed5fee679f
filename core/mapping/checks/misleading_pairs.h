// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Verified pairs that are wrong in themselves, whatever the model is like: they bear no witness
/// against it.
class MisleadingPairs {
 public:
  /// `is_explained`: per pair of the graph, by the model (JudgePairs).
  MisleadingPairs(const MappingState& state, std::vector<uint8_t> is_explained);

  [[nodiscard]] bool IsMisleading(uint32_t pair) const {
    return LeadsBack(pair) || TurnsOtherwise(pair) || LeadsOtherwise(pair) ||
           LeadsOtherwiseThanChain(pair) || StandsStill(pair);
  }

 private:
  /// Of two images of a drive that follow one another, at most one place between: the pair leads
  /// backwards (more than 120 degrees off the model's step), where the model goes on as it does
  /// before or behind them (60 degrees or less). Windows that repeat make such pairs, each window
  /// taken for the next; a camera that turns back for one place does not go on as before.
  [[nodiscard]] bool LeadsBack(uint32_t pair) const;
  /// The pair turns otherwise than the model (by more than 2 degrees), and explained pairs, of as
  /// many matches or more each, as the model does (to 0.75 degrees): two by way of a third image,
  /// or three by way of two. Lengths that are wrong turn nothing, and where the model is askew no
  /// pairs across agree. Round a corner 976 matches turned by 36 degrees otherwise than 2,417,
  /// 2,802 and 1,231 did from each to the next.
  [[nodiscard]] bool TurnsOtherwise(uint32_t pair) const;
  /// The pair leads elsewhere than by way of a third image: whatever the lengths that GNSS leaves
  /// (SharesByGnss) of two explained pairs, of as many matches or more each, which turn and lead as
  /// the model does (to 0.75 and 2 degrees), from the one image by way of the third to the other
  /// the direction lies between theirs, and the pair's is more than 4 degrees off all that do.
  /// Matches of one facade leave two poses open, or are those of the next window. Right pairs lead
  /// to a degree as the model does, such ones were 15 to 25 degrees off it.
  [[nodiscard]] bool LeadsOtherwise(uint32_t pair) const;
  /// The same by way of two images: the chain of three such pairs goes on (60 degrees or less
  /// between their directions), and whatever its lengths it leads no further from the middle of
  /// them than any of the three does; the pair's direction is more than 4 degrees beyond that.
  /// Round the corner of a block two panoramas 35 m apart took windows for others by 326 matches,
  /// 129 degrees off, where 789, 650 and more led from each to the next.
  [[nodiscard]] bool LeadsOtherwiseThanChain(uint32_t pair) const;
  /// The rays of the pair hardly part, as if no way lay between its images, and two explained
  /// pairs, of half as many matches or more each, lead from the one by way of a third to the other,
  /// in directions of their own that go on (60 degrees or less), with rays that part four times as
  /// much and more: then the pair's baseline is longer than either. A camera that stands or comes
  /// back has no such ways. Windows one step apart make such pairs, each taken for the next.
  [[nodiscard]] bool StandsStill(uint32_t pair) const;
  /// Pairs of the image that `counts(pair)`, by the other image of each.
  template <typename Counts>
  [[nodiscard]] std::map<ImageSlot, uint32_t> PairsOf(ImageSlot image, const Counts& counts) const;
  /// Whether `says_so(before, third, behind)` of any two pairs that lead from the one image of the
  /// pair by way of a third to the other, both of which `counts(pair)`.
  template <typename Counts, typename SaysSo>
  [[nodiscard]] bool AnyByWayOfThird(uint32_t pair,
                                     const Counts& counts,
                                     const SaysSo& says_so) const;
  /// The same of three pairs by way of two other images: `says_so(to_second, second, onward, third,
  /// to_last)`, from the first image of the pair on.
  template <typename Counts, typename SaysSo>
  [[nodiscard]] bool AnyByWayOfTwo(uint32_t pair,
                                   const Counts& counts,
                                   const SaysSo& says_so) const;
  /// Of the ways from `first` to `third` and from there to `last`, what part the second is of both
  /// together: the least and the most, by three sigmas of positions. 0 and 1 where there are none,
  /// or where they have it otherwise than the model: then they are no witness for it.
  [[nodiscard]] std::array<double, 2> SharesByGnss(ImageSlot first,
                                                   ImageSlot third,
                                                   ImageSlot last) const;
  [[nodiscard]] const TwoViewGeometry& GeometryOf(uint32_t pair) const;
  /// By the pair's own geometry, from `image`, one of its two, to the other; not a unit vector.
  [[nodiscard]] Eigen::Vector3d WayInWorld(uint32_t pair, ImageSlot image) const;
  [[nodiscard]] bool IsBorneOut(uint32_t pair, size_t min_matches) const;
  /// The same, and it leads as the model does.
  [[nodiscard]] bool LeadsAsModel(uint32_t pair, size_t min_matches) const;
  /// Between the pair's rotation and the model's.
  [[nodiscard]] double TurnErrorOf(uint32_t pair) const;
  /// So many registered places on in the drive; nullopt beyond its ends.
  [[nodiscard]] std::optional<ImageSlot> At(ImageSlot image, int places_on) const;

  const MappingState& state_;
  std::vector<uint8_t> is_explained_;
  std::vector<ImageSlot> sequence_{};  ///< registered, drive by drive as they were taken
  std::vector<size_t> place_;          ///< in it, per registered image
};

}  // namespace orbweave
