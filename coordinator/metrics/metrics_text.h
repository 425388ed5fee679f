// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "coordinator/coordinator.h"
#include "coordinator/metrics/metrics_counters.h"

namespace orbweave {

/// What metrics_counters.h and metrics_snapshot.h list, in Prometheus' text format 0.0.4.
[[nodiscard]] std::string MetricsText(Coordinator& coordinator, const MetricsCounters& counters);

}  // namespace orbweave
