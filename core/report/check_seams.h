// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/io/page/job_report.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "seams_fit": share of the certified seams whose two sides agree. One that does not is a place to
/// look at; when most do not, the model is torn.
[[nodiscard]] std::optional<CrossCheck> CheckSeamFits(const JobReport& report);

/// "seams_in_loops": share of the seams that no loop contradicts.
[[nodiscard]] std::optional<CrossCheck> CheckSeamsInLoops(const JobReport& report);

/// "clusters_certified": share of the clusters with seams of which one at least is certified. One
/// all of whose seams could not be hangs by what nobody has looked at.
[[nodiscard]] std::optional<CrossCheck> CheckCertified(const JobReport& report);

}  // namespace orbweave
