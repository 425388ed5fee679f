// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coordinator/job_service.h"
#include "coordinator/journal/journal.h"
#include "coordinator/kept_blobs.h"
#include "core/pipeline/admin_api.h"

namespace orbweave {

/// See AdminApi::CollectGarbage. May run beside everything a coordinator does: what it puts,
/// asks for or finds meanwhile counts as used.
[[nodiscard]] absl::StatusOr<GarbageReport> CollectGarbage(const GarbageOptions& options,
                                                           const PlanLookup& find_plan,
                                                           KeptBlobs& blobs,
                                                           Journal& journal);

}  // namespace orbweave
