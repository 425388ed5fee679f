// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "cli/inspect/inspected_job.h"

namespace orbweave {

/// One line on an image: name, size, and whether a model holds it, with the reason where none
/// does. `results`: as of InspectedJob::Results.
[[nodiscard]] std::string ImageStateText(const InspectedJob& job,
                                         const std::optional<JobResults>& results,
                                         ImageId image);

/// "registered in model 0", "placed loosely: REASON", "left out: REASON".
[[nodiscard]] std::string RegistrationText(const JobReport& report, ImageId image);

}  // namespace orbweave
