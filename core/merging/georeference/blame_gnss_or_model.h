// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "core/base/stage_context.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/georeference.h"
#include "core/merging/georeference/gnss_agreement.h"
#include "core/merging/georeference/gnss_track.h"

namespace orbweave {

/// Where no similarity holds, or hardly more than half of the positions agree with it: what else
/// may be wrong with them, or with the model, as a check and, where nothing holds, as the reason.
[[nodiscard]] absl::Status BlameGnssOrModel(const std::vector<GnssDrive>& drives,
                                            const std::optional<Gravity>& gravity,
                                            const GnssAgreement& agreement,
                                            const StageContext& context,
                                            Georeference& result);

}  // namespace orbweave
