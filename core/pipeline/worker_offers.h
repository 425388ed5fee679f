// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/stage_needs.h"

namespace orbweave {

/// What a worker has for all its tasks together. One that states nothing has a thread for each slot
/// (so that a task of one thread has room in every slot) and memory whose limit nobody knows.
struct WorkerOffers {
  uint64_t memory_bytes = 0;  ///< 0: not known, and enough for every task
  uint32_t threads = 0;       ///< 0: one for each slot
  uint32_t gpus = 0;

  friend bool operator==(const WorkerOffers&, const WorkerOffers&) = default;
};

/// The same with the threads of a worker of `slots` slots said.
[[nodiscard]] WorkerOffers WithThreads(const WorkerOffers& offers, uint32_t slots);

/// How many tasks of these needs a worker of `slots` slots has room for at a time; 0: none, ever.
[[nodiscard]] uint32_t TasksAtOnce(const WorkerOffers& offers,
                                   uint32_t slots,
                                   const StageNeeds& needs);

/// Whether a task of these needs has room beside others of `taken` altogether.
[[nodiscard]] bool HasRoom(const WorkerOffers& offers,
                           uint32_t slots,
                           const StageNeeds& taken,
                           const StageNeeds& needs);

/// Of needs that none of these workers (all with threads said) can meet, what is missing: "1 GPU
/// (no worker has any) and 9 threads (the most a worker has is 8 threads)". Where each need can be
/// met by somebody and nobody meets all, all of them.
[[nodiscard]] std::string DescribeMissing(const std::vector<WorkerOffers>& workers,
                                          const StageNeeds& needs);

}  // namespace orbweave
