// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/io/job_report.h"
#include "core/merging/adjust_globally.h"

namespace orbweave {

/// The uncertainty of one world's poses for the report: median and 95 % quantile over its images,
/// and the ten whose positions are least certain, worst first.
[[nodiscard]] ReportUncertainty SummariseUncertainty(const GloballyAdjusted& world);

}  // namespace orbweave
