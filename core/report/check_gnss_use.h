// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// "gnss_used": of a model that GNSS puts on earth the share of its positions that agree, or where
/// they do and lie too far off their median distance in metres; of the first model, 0, too where
/// its positions are not used. Nothing of others, nor where positions are too few to tell.
[[nodiscard]] std::optional<CrossCheck> CheckGnssUse(const JobResults& results,
                                                     const JobReport& report,
                                                     size_t model);

}  // namespace orbweave
