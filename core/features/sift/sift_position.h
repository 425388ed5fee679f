// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace orbweave::internal {

/// An extremum of the difference of Gaussians, in the grid of its octave.
struct SiftPosition {
  uint32_t octave = 0;  ///< number in ScaleSpacePlan::octaves
  int32_t column = 0;   ///< of the nearest pixel
  int32_t row = 0;
  int32_t scale = 0;  ///< nearest level, 1 ... kSiftScales
  float dx = 0.0F;    ///< from the nearest pixel and level, within half of one
  float dy = 0.0F;
  float dscale = 0.0F;
  float response = 0.0F;  ///< contrast, for greys in 0 ... 1
};

}  // namespace orbweave::internal
