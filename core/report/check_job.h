// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// What only the job as a whole knows of its models, as cross checks. `report` has everything but
/// its checks and verdict. In order, each where it applies:
///   images_registered       share of the job's images that a model observes
///   images_in_one_frame     share of those that lie in the largest frame: all georeferenced models
///                           share one, every other model has its own
///   connected_in_one_model  share of those that are in the model that holds most of their part,
///                           over all parts that verified pairs hold together
///   seams_fit               share of the certified seams whose two sides agree
///   seams_in_loops          share of the seams that no loop contradicts
///   clusters_certified      share of the clusters with seams of which one at least is certified
///   adjustment_converged    what the last step of an adjustment that stopped early moved
///   uncertainty_known       share of the registered images whose sigmas are known
///   gnss_used               of each model that GNSS puts on earth: share of its positions that
///                           agree, or where they do and lie too far off their median distance in
///                           metres; 0 where those of the first model are not used
[[nodiscard]] std::vector<CrossCheck> CheckJob(const JobResults& results, const JobReport& report);

}  // namespace orbweave
