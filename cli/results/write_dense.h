// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"
#include "core/pipeline/coordinator_api.h"
#include "core/report/dense_report.h"

namespace orbweave {

/// Writes what a finished dense job leaves into `folder`, one tile after the other: tiles/*.ply,
/// cloud.las (in the UTM zone of the model's origin where it stands on earth), from_above.png,
/// report.json and report.html. What an earlier run left and this one has not is removed. Codes of
/// WriteFileAtomically.
[[nodiscard]] absl::StatusOr<DenseReport> WriteDense(ClientApi& coordinator,
                                                     const JobStatus& status,
                                                     const std::string& folder);

}  // namespace orbweave
