// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/scene/ids.h"

namespace orbweave {

/// How far rays bear out lengths of the model.
struct LengthAgreement {
  double told = 0.0;      ///< rays that say how long it is, weighed
  double agreeing = 0.0;  ///< of them those that say what the model has

  void Add(const LengthAgreement& other) {
    told += other.told;
    agreeing += other.agreeing;
  }
  /// 1 where nothing is told.
  [[nodiscard]] double Share() const { return told > 0.0 ? agreeing / told : 1.0; }
};

/// That of the baseline of a pair (MeasurePairLengths).
struct PairLength {
  ImagePair pair{};
  LengthAgreement agreement{};
};

/// That of the way from an image to the next of its drive (MeasureGapLengths); ids may fall.
struct GapLength {
  ImagePair between{};
  uint32_t pairs = 0;  ///< that lead across and tell something
  LengthAgreement agreement{};
  double here = 0.0;       ///< rays that say closely what the model has,
  double elsewhere = 0.0;  ///< and those of the length that most say (GapShift)
  /// Rays to one wall of the street that say closely what the model has, of these and those of
  /// another length that they say (FindWallShift).
  LengthAgreement wall{};
  /// |log| of the ratio of its sides' scales (MeasureScaleJumps); 0 where GNSS bears out the way.
  double scale_jump = 0.0;
  /// Matches of the pairs that lead across, and those that agree with how the model has its two
  /// sides stand and turn to each other (AgreementOfMatches).
  LengthAgreement matches{};
  /// Rays of all pairs that lead across, or the matches of its two images if these are more, as of
  /// a general pair whose rays hardly meet; and those of the side that tells more that say how long
  /// these are, because pairs that stay on their side share them; with them, once they are
  /// added (AddTyingRays), those that tie its ends together past it.
  uint32_t rays = 0;
  uint32_t telling_rays = 0;
  /// By rays that crowd at the model's length and nowhere else, or by GNSS, which refutes what else
  /// rays say (MeasureGapLengths).
  bool is_borne_out = false;
};

}  // namespace orbweave
