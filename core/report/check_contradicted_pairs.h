// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/report/borne_out_by_gnss.h"
#include "core/report/job_results.h"
#include "core/report/pairs_of_job.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "pairs_contradicted": of the verified pairs whose two images are registered in the same model,
/// the share that contradicts it (JudgePairsOfJob).
/// Places that look alike make such pairs one by one, a model that is folded or torn where it is
/// so: doubtful above one in twenty where an image has two or more and they are half of its pairs,
/// bad above one in two. Pairs of images that GNSS tells apart (BorneOutByGnss) are no witnesses,
/// for or against. Absent where no model has another one.
[[nodiscard]] std::optional<CrossCheck> CheckContradictedPairs(const JobResults& results,
                                                               const PairsOfJob& of_job,
                                                               const BorneOutByGnss& gnss);

}  // namespace orbweave
