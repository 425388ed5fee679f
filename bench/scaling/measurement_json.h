// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "bench/scaling/job_measurement.h"

namespace orbweave {

/// A measurement as JSON, for a process that is not the one that measured; and back. DataLoss: it
/// is none, or lacks something.
[[nodiscard]] std::string MeasurementJson(const JobMeasurement& measurement);
[[nodiscard]] absl::StatusOr<JobMeasurement> ParseMeasurement(std::string_view json);

}  // namespace orbweave
