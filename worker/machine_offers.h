// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/pipeline/worker_offers.h"

namespace orbweave {

/// What this machine has for tasks: its memory, or what a control group leaves of it, and NVIDIA's
/// GPUs that can be opened here (device files nvidia0, nvidia1, ...). Nothing is said of what
/// cannot be found out, nor of threads. `root`: the folder to look in instead of /.
[[nodiscard]] WorkerOffers OffersOfMachine(const std::string& root = "");

/// What the worker number `index` (from 0) of `count` on a machine offers when all offer alike:
/// GPUs, which cannot be divided, go to the first ones.
[[nodiscard]] WorkerOffers ShareOf(const WorkerOffers& machine, uint32_t index, uint32_t count);

}  // namespace orbweave
