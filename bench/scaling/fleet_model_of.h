// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bench/scaling/job_measurement.h"
#include "bench/scaling/simulate_schedule.h"

namespace orbweave {

/// The machines on which a job ran, as the simulation sees them: slots, share of processors, link
/// and overhead as they were; of a job that ran some time ago, what is usual on one machine. Where
/// no network is between them bytes take no time of their own.
[[nodiscard]] FleetModel FleetModelOf(const JobMeasurement& job);

}  // namespace orbweave
