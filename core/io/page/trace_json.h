// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orbweave {

/// One finished attempt at a task.
struct TraceRow {
  std::string stage{};
  uint32_t part = 0;
  std::string worker{};
  uint32_t slot = 0;
  double start_s = 0.0;  ///< since the job was submitted
  double end_s = 0.0;
  bool ok = true;
};

/// Chrome trace (chrome://tracing, Perfetto): one process per worker, one lane per slot, one bar
/// per attempt. Workers in natural name order; rows may come in any order, equal sets give equal
/// bytes.
[[nodiscard]] std::string TraceJson(std::vector<TraceRow> rows);

}  // namespace orbweave
