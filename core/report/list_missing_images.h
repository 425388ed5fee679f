// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// Fills report.not_registered, and the reasons in report.images, from what these say: excluded
/// files and all images that no model observes, each with its reason. Adds a warning with the
/// number of those that are placed loosely and the reason that most of them share.
void ListMissingImages(const JobResults& results, JobReport& report);

}  // namespace orbweave
