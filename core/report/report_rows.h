// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// What the report says of each cluster, in order of clusters.
[[nodiscard]] std::vector<ReportCluster> ClusterRows(const JobResults& results);

/// The same of each seam. Seams speak of submodels; the report names their clusters.
[[nodiscard]] std::vector<ReportSeam> SeamRows(const JobResults& results);

[[nodiscard]] ReportWiderPairs WiderPairsRow(const WiderPairs& wider);

[[nodiscard]] ReportAdjustment AdjustmentRow(const GlobalAdjustReport& report);

/// The same of each model; `report` has its images already.
[[nodiscard]] std::vector<ReportModel> ModelRows(const JobResults& results,
                                                 const JobReport& report);

}  // namespace orbweave
