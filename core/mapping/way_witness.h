// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/mapping/asked_rays.h"
#include "core/mapping/gap_votes.h"
#include "core/mapping/gnss_ways.h"

namespace orbweave {

/// How far what lies behind a way would have to be shifted along it to have the length that GNSS
/// says: as most rays of either side of it say that say what GNSS allows within two sigmas
/// (FindGapShiftWithin), eight at least; as far as GNSS has it where rays say nothing of the way
/// at all; none where they say what the model has and nothing that GNSS allows.
[[nodiscard]] std::vector<double> ShiftsByGnss(const AskedRays& asked,
                                               const GapVotes& gap,
                                               const GnssWay& way);

/// Which ways of a model that rays are asked about have the length that GNSS says.
class WayWitness {
 public:
  explicit WayWitness(const AskedRays& asked);

  /// Whether GNSS knows the way to a fifth of its length, has it as it is up to two sigmas, and
  /// would have it off by more than three if it were longer by `elsewhere`, the shift that clearly
  /// more rays want, where that is not 0.
  [[nodiscard]] bool BearsOut(const GapVotes& gap, double elsewhere) const;

 private:
  const AskedRays& asked_;
  std::map<std::pair<ImageSlot, ImageSlot>, GnssWay> ways_{};
};

}  // namespace orbweave
