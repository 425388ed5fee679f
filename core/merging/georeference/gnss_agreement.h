// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "core/merging/georeference/georeference.h"
#include "core/merging/georeference/gnss_positions.h"

namespace orbweave {

/// Of sound positions and a sound model more agree.
inline constexpr double kUsualAgreeingShare = 0.7;

/// GnssPositions within three sigmas of the model, horizontally: those that they state or, where
/// that is more, those of their scatter, which of a handful may be next to nothing.
struct GnssAgreement {
  size_t agreeing = 0;
  size_t all = 0;
  double within_m = 0.0;  ///< in the median

  [[nodiscard]] double Share() const {
    return static_cast<double>(agreeing) / static_cast<double>(all);
  }
  [[nodiscard]] bool IsUsual() const { return Share() >= kUsualAgreeingShare; }
  /// Of a majority: by chance a position would lie as near anywhere along a street of that extent.
  [[nodiscard]] bool IsEvident(double extent_m) const;
  [[nodiscard]] std::string Sentence() const;
};

/// Measures the scatter of GNSS about the model as `result` has it, and drops the similarity, with
/// the reason, where GNSS cannot carry its scale (GeoreferenceReconstruction).
[[nodiscard]] GnssAgreement MeasureAgreement(const GnssPositions& positions, Georeference& result);

}  // namespace orbweave
