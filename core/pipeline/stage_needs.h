// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace orbweave {

/// What one task of a stage asks of the worker that runs it, in one of the worker's slots. A worker
/// that offers less of any of the three is given no such task. The default asks for nothing that
/// every worker has not got.
struct StageNeeds {
  uint64_t memory_bytes = 0;  ///< 0: not known, or too little to ask for
  uint32_t threads = 1;       ///< threads that the task keeps busy
  uint32_t gpus = 0;
};

}  // namespace orbweave
