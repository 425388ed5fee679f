// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/mapping/model/mapping_state.h"
#include "core/mapping/model/move_images.h"

namespace orbweave {

/// The way from a registered image to the next of its line, or to the next but one, and how long
/// GNSS has it, in the model's unit.
struct GnssWay {
  ImageSlot image = 0;
  ImageSlot next = 0;
  double length = 0.0;
  double sigma = 0.0;
  bool leads_to_next = true;  ///< not to the next but one

  /// By how many sigmas the model has it longer.
  [[nodiscard]] double Misfit(const MappingState& state) const;
};

/// What GNSS says of the ways along the lines of a model (FindStreetLines), and how far it is to be
/// believed. Metres of a unit of the model: of the ways about, fifteen places on either side, where
/// half of them agree best on |G_b - G_a| / |C_b - C_a|, with positions G and centres C. Stated
/// sigmas of steps are multiplied with what their errors say (FactorOfErrors), within drives and
/// between them each for themselves; and no way is known better than to a twentieth. All as the
/// model was when this was made.
class GnssWays {
 public:
  /// `tolerance_px`: of lines (FindStreetLines).
  GnssWays(const MappingState& state, double tolerance_px);

  /// Along the lines.
  [[nodiscard]] const std::vector<GnssWay>& Ways() const { return ways_; }
  /// The way from an image to the next; null where GNSS says nothing of it.
  [[nodiscard]] const GnssWay* WayToNext(ImageSlot image, ImageSlot next) const;
  /// Sum of all squared misfits, 25 of each at most: a position that is off by tens of metres
  /// speaks no louder.
  [[nodiscard]] double Misfit(const MappingState& state) const;
  /// The same of the ways of which one end is among `images` and the other is not.
  [[nodiscard]] double MisfitAtEdges(const MappingState& state, const CandidateMove& images) const;

 private:
  std::vector<GnssWay> ways_{};
  std::map<std::pair<ImageSlot, ImageSlot>, size_t> place_of_way_{};
};

}  // namespace orbweave
