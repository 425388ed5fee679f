// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/artifacts/stage_results.h"
#include "core/io/page/job_report.h"
#include "core/io/page/measure_reconstruction.h"
#include "core/merging/alignment/align_submodels.h"
#include "core/merging/alignment/review_seams.h"
#include "core/merging/checks/certify_seams.h"
#include "core/partitioned_ba/global_options.h"
#include "core/report/job_results.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

[[nodiscard]] ClusterSummary SummariseCluster(const ClusterResult& cluster);

/// The part of the report that follows from results alone: counts, residuals (recomputed from
/// the models), clusters, seams, GNSS, one row per image, and a reason for every image that is not
/// registered. Stages, workers, times and options are the caller's.
[[nodiscard]] JobReport BuildJobReport(const JobResults& results);

}  // namespace orbweave
