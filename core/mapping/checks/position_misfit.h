// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// How far the images of a model are from their positions, seen from above: what GNSS makes of it
/// as a whole. Of one step GNSS of some metres knows little; but where six panoramas were drawn
/// together, a house for each, the last stands tens of metres from its position, and so do those
/// around it.
///
/// Every image lies under a similarity of its own, about the vertical, which fits the sixty places
/// around it best (FindPlacedImages; reweighted least squares, Cauchy): long streets may bend by
/// more than positions are exact.
class PositionMisfit {
 public:
  /// `tolerance_px`: of lines (FindStreetLines).
  PositionMisfit(const MappingState& state, double tolerance_px);

  /// Whether positions tell anything.
  [[nodiscard]] bool Tells() const { return !errors_.empty(); }
  /// Sum of r^2 / (1 + r^2 / 9) over the images that `other`, of another model or the same, has as
  /// well, with the distances r of images from their positions in sigmas that are what positions
  /// prove to be worth (ScatterOfPositions), in the one model or in the other: one that is wrong
  /// takes GNSS for worse than it is. 2 of an image that is right, and 9 at most, as some positions
  /// are wrong (Geman and McClure, Statistical methods for tomographic image reconstruction, 1987).
  [[nodiscard]] double Beside(const PositionMisfit& other) const;
  /// The mean of the same over all images.
  [[nodiscard]] double MeanBeside(const PositionMisfit& other) const;

 private:
  std::map<ImageSlot, double> errors_{};  ///< in sigmas as stated
  double scatter_ = 1.0;
};

}  // namespace orbweave
