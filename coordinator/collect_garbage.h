// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coordinator/job_desk.h"
#include "coordinator/journal.h"
#include "core/storage/blob_store.h"

namespace orbweave {

/// See CoordinatorApi::CollectGarbage. May run beside everything a coordinator does: what it puts,
/// asks for or finds meanwhile counts as used.
[[nodiscard]] absl::StatusOr<GarbageReport> CollectGarbage(const GarbageOptions& options,
                                                           const JobDesk::FindPlan& find_plan,
                                                           BlobStore& blobs,
                                                           Journal& journal);

}  // namespace orbweave
