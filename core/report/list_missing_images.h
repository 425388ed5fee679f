// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/io/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// Fills report.not_registered from report.images: excluded files and all images that no model
/// observes, each with its reason. Adds a warning per cluster that has images placed loosely, so
/// that a cluster that failed is named.
void ListMissingImages(const JobResults& results, JobReport& report);

}  // namespace orbweave
