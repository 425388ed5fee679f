// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "core/base/status.h"
#include "core/pipeline/worker_api.h"

namespace orbweave {

/// Whether a worker that joins is one that there can be. FailedPrecondition: of another version.
/// InvalidArgument: a name that is not one as identities have them (CheckName), or two with '/'
/// between them; not 1 to 1,024 slots; offers beyond 1 PiB of memory, 65,536 threads or 4,096 GPUs.
[[nodiscard]] absl::Status CheckWorker(const WorkerInfo& worker);

}  // namespace orbweave
