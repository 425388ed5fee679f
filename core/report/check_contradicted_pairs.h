// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "pairs_contradicted": of the verified pairs whose two images are registered in the same model,
/// the share that a cluster's reconstruction contradicts (ClusterSummary::contradicted_pairs).
/// Pairs of images that GNSS tells apart (BorneOutByGnss) are no witnesses, for or against. Absent
/// where no model has another one.
[[nodiscard]] std::optional<CrossCheck> CheckContradictedPairs(const JobResults& results);

}  // namespace orbweave
