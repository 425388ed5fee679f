// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/metrics/metrics_text.h"

#include <prometheus/text_serializer.h>

#include <vector>

#include "coordinator/metrics/metrics_snapshot.h"

namespace orbweave {

std::string MetricsText(Coordinator& coordinator, const MetricsCounters& counters) {
  std::vector<prometheus::MetricFamily> families = counters.registry()->Collect();
  const absl::StatusOr<std::vector<JobStatus>> jobs = coordinator.ListJobs();
  const absl::StatusOr<std::vector<WorkerStatus>> workers = coordinator.ListWorkers();
  if (jobs.ok() && workers.ok()) {
    for (prometheus::MetricFamily& family :
         SnapshotMetrics(*jobs, *workers, coordinator.blob_traffic(), coordinator.SlotsWanted())) {
      families.push_back(std::move(family));
    }
  }
  return prometheus::TextSerializer().Serialize(families);
}

}  // namespace orbweave
