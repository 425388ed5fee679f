// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/job_api.h"

namespace orbweave::testing {

/// A job of two stages half a minute after its submission: the first done, two tasks of the second
/// at work.
inline JobStatus TwoStages() {
  JobStatus status{.elapsed_s = 30.0};
  status.stages = {{.stage = "first",
                    .tasks_total = 4,
                    .tasks_done = 4,
                    .wall_s = 20.0,
                    .busy_s = 20.0,
                    .has_parts = true},
                   {.stage = "second",
                    .tasks_total = 10,
                    .tasks_done = 4,
                    .tasks_running = 2,
                    .wall_s = 8.0,
                    .fraction_running = 1.0,
                    .busy_s = 8.0,
                    .has_parts = true}};
  return status;
}

}  // namespace orbweave::testing
