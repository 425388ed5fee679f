// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/task.h"

namespace orbweave {

/// What the tasks of one stage took together, over all its runs.
struct StageTotals {
  std::string stage{};
  uint32_t runs = 0;  ///< those without tasks not counted
  uint32_t tasks = 0;
  double cpu_s = 0.0;
  double longest_cpu_s = 0.0;  ///< sum over runs of the longest task: what no worker can divide
  uint64_t bytes_in = 0;
  uint64_t bytes_out = 0;
  uint64_t peak_memory_bytes = 0;  ///< of any one process
};

/// Sums by stage, in the order in which stages first ran. `tasks` in (run, part) order.
[[nodiscard]] std::vector<StageTotals> SumByStage(const std::vector<MeasuredTask>& tasks);

}  // namespace orbweave
