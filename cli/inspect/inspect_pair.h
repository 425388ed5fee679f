// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/inspect/inspected_job.h"
#include "cli/inspect/inspection.h"

namespace orbweave {

/// Two different images of a job: what matching made of them, now repeated or done for the first
/// time, and what view graph, GNSS and model say of them. `first` is shown above.
[[nodiscard]] absl::StatusOr<Inspection> InspectPairOfJob(InspectedJob& job,
                                                          ImageId first,
                                                          ImageId second);

}  // namespace orbweave
