// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/io/job_report.h"
#include "core/merging/adjust_globally.h"
#include "core/merging/align_submodels.h"
#include "core/merging/review_seams.h"
#include "core/scene/image_manifest.h"
#include "core/stages/stage_results.h"

namespace orbweave {

/// The results of a finished job, decoded.
struct JobResults {
  ImageManifest manifest{};
  std::vector<std::string>
      image_problems{};  ///< per image: why it has no features, mostly empty; or empty list
  DividedViewGraph view_graph{};
  std::vector<ClusterResult> clusters{};
  Alignment alignment{};
  PartitionReview review{};
  std::vector<GloballyAdjusted> worlds{};       ///< most images first
  std::vector<SeamCertificate> certificates{};  ///< of all worlds
};

/// The part of the report that follows from results alone: counts, residuals (recomputed from the
/// model), clusters, seams, GNSS, one row per image, and a reason for every image that is not
/// registered. Stages, workers, times and options are the caller's.
[[nodiscard]] JobReport BuildJobReport(const JobResults& results);

}  // namespace orbweave
