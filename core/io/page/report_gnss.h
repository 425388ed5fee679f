// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/io/page/job_report.h"

namespace orbweave {

/// Images whose GNSS positions their models contradict, the furthest off first.
[[nodiscard]] std::vector<const ReportImage*> ContradictedPositions(const JobReport& report);

/// How GNSS agrees with the models, and by how much it is off east, north and up where it is
/// contradicted. Empty when no image has a position.
[[nodiscard]] std::string GnssHtml(const JobReport& report);

}  // namespace orbweave
