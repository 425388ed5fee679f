// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fleet/see_workers_off.h"

#include <algorithm>

#include "core/base/sleep.h"

namespace orbweave {
namespace {

bool IsAnybodyThere(Coordinator& coordinator) {
  const absl::StatusOr<std::vector<WorkerStatus>> workers = coordinator.ListWorkers();
  return workers.ok() &&
         std::ranges::any_of(*workers, [](const WorkerStatus& worker) { return worker.alive; });
}

}  // namespace

void SeeWorkersOff(Coordinator& coordinator, double lease_s) {
  constexpr double kLook_s = 0.05;
  constexpr double kLongest_s = 10.0;
  for (double left_s = std::min(kLongest_s, 0.2 * lease_s); left_s > 0.0; left_s -= kLook_s) {
    if (!IsAnybodyThere(coordinator)) return;
    SleepUnlessStopped(kLook_s, {});
  }
}

}  // namespace orbweave
