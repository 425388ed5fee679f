// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// An image of a drive as it stands in a model.
struct DriveStop {
  uint32_t place = 0;  ///< in the drive, with captures that are not in the model (CapturesAlong)
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// One that does not stand where the even steps around it have it.
struct UnevenStop {
  size_t stop = 0;
  size_t first = 0;         ///< the run of steps that is judged, from here
  size_t last = 0;          ///< to here
  double share = 0.0;       ///< of the way from first to last, how much leads to the stop
  double even_share = 0.0;  ///< of its places
  double step = 0.0;        ///< as steps are around
  double off_steps = 0.0;   ///< the difference of the shares, in such steps
};

/// What is off by less is not uneven.
inline constexpr double kLeastUneven_steps = 1.0 / 3.0;

/// Images that stand too far along the way of a drive, or not far enough, while those around them
/// are as far apart as ever: where houses repeat, one is taken for the next, points agree, and the
/// step to it is too long by a window or a house, and one behind it too short by the same.
///
/// Judged are runs of two to four steps, of at most three places each, whose length T is that of
/// their G places to 15 %, by the median step s of twelve on either side, and such of two whose
/// ends are that far apart, which T then is: the one between was flung out. Of the way L_j to one
/// inside, g_j places on, d_j = |L_j - T g_j / G| / s is asked. It is uneven beyond a third, and
/// beyond three times the distance of the quartiles of the steps around in units of s, as far as
/// that is below 0.3; a camera that is carried by hand is not asked. The worst first; runs do not
/// overlap. Whoever stops, or leaves an image out, makes short steps or long ones, but not both
/// that add up. In forty right models and true ways of cars and rendered streets, whose steps vary
/// by 10 to 20 %, d was 0.2 at most, of mapping cars 0.04; where an image stood a window or a house
/// off, 0.3 to 1. Runs with a step below a fiftieth of s are left alone: a video that was sampled
/// twice at one frame, and then went on by two steps, has such (npr_walking_boy has five, of 0.05
/// to 1.5 %). A street that seems to stop where houses repeat has them too, of 1.2 to 2.5 %, but
/// nothing that tells how long they are (CheckToldSteps).
///
/// `stops`: ascending by place. Ascending by stop.
[[nodiscard]] std::vector<UnevenStop> FindUnevenStops(std::span<const DriveStop> stops);

/// Whether positions have the stop where the model has it rather than at the even place, and know
/// that: between the first and the last of the run they tell the difference to two fifths.
[[nodiscard]] bool IsBorneOut(const UnevenStop& uneven,
                              const PosePrior& first,
                              const PosePrior& stop,
                              const PosePrior& last);

/// A step that leads hardly anywhere, or back, while those around it lead on as ever.
struct VanishedStep {
  size_t stop = 0;     ///< from this one to the next
  double step = 0.0;   ///< as steps are around
  double share = 0.0;  ///< of such a step; negative: it leads back
  /// The one of its stops that hangs at the other alone: the drive begins or ends there, or goes on
  /// more than three steps away. Nullopt: it lies between two steps as usual.
  std::optional<size_t> end{};
};

/// What is longer has not vanished.
inline constexpr double kMostVanished_steps = 1.0 / 3.0;

/// Steps of a fiftieth to a third of the median step s around, as FindUnevenStops has it, between
/// two that are as long as that to 30 %, or beside one and the end of a run; and those that lead
/// back (by 120 degrees or more) between two such that lead the same way (to 60). Where houses are
/// as wide as a step is long a panorama sees the next house where it saw this one: the rays of the
/// pair hardly meet, as of a camera that stands, thousands of points agree, and all that follows
/// stands one step too near, or two. A camera that stops slows down before, and is late; one that
/// is carried by hand is not asked, and a frame that a video has twice is left alone. Of 2,088
/// steps of 114 models of rendered and real streets, most of them right, one was such between two
/// others: 12.8 m at 3 % of the others, which 1,912 rays bore out.
///
/// `stops`: ascending by place. Ascending by stop.
[[nodiscard]] std::vector<VanishedStep> FindVanishedSteps(std::span<const DriveStop> stops);

/// Whether the step is wrong, as far as positions tell: unless they have it as short, or lead back,
/// rather than as long as the steps as usual beside it, and know the difference to two fifths. At
/// an end, where cameras do start and stop, only where they are longer by three sigmas than the
/// model has it and rather as long as those beside. `stops`: those it was found among; `prior_of`:
/// of each of them.
[[nodiscard]] bool IsDoubted(const VanishedStep& vanished,
                             std::span<const DriveStop> stops,
                             const std::function<const PosePrior&(size_t)>& prior_of);

}  // namespace orbweave
