// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <prometheus/metric_family.h>

#include <vector>

#include "core/pipeline/job_api.h"
#include "core/storage/blob_store.h"

namespace orbweave {

/// What a coordinator is like at this moment. Of jobs that ended only their number is told, so that
/// what is told does not grow for ever.
///   orbweave_jobs{state}
///   orbweave_tasks{job, stage, state}  state: ready (or waiting to be tried again), running, done
///   orbweave_task_retries{job, stage}  failed attempts after which a task was tried again
///   orbweave_job_done_ratio{job}, orbweave_job_eta_seconds{job}  the latter once it is known
///   orbweave_workers{state}            state: at_work, draining, gone
///   orbweave_slots, orbweave_slots_busy  of workers that are there
///   orbweave_slots_wanted              see WantedSlots
///   orbweave_blob_bytes_total{direction}
[[nodiscard]] std::vector<prometheus::MetricFamily> SnapshotMetrics(
    const std::vector<JobStatus>& jobs,
    const std::vector<WorkerStatus>& workers,
    const BlobTraffic& traffic,
    uint32_t slots_wanted);

}  // namespace orbweave
