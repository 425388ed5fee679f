// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/io/page/job_report.h"
#include "core/partitioned_ba/global_options.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// The uncertainty of one model's poses for the report: median and 95 % quantile over its images,
/// and the ten whose positions are least certain, worst first. Heights that are not known would
/// drown what is known along the ground.
[[nodiscard]] ReportUncertainty SummariseUncertainty(
    const UncertaintyReport& report,
    const std::map<ImageId, RegisteredImage>& images,
    bool heights_are_known);

}  // namespace orbweave
