// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/report/borne_out_by_gnss.h"
#include "core/report/job_results.h"
#include "core/report/pairs_of_job.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "pairs_explained": of the verified pairs between neighbours that were judged (JudgePairsOfJob),
/// the share that the model explains. Neighbours follow one another in their drive (at most two
/// places apart, not left off between), or are of two stretches, or two passages, and stand beside
/// each other in the model, three steps apart at most (StepsApart). They see the same thing, so a
/// model that contradicts such pairs is torn or folded there: doubtful for one, bad for more than
/// one in fifty. One is outvoted, and counts as of places that look alike, where of the pairs that
/// lead across both its images, from up to three places further on either side, or those around
/// either image, where they are of two stretches, more than two thirds are explained. Where all are
/// explained, contradicted pairs of images further apart are places that look alike and that the
/// model told apart, unless they come in runs: three or more images in a row on both sides, (a, b),
/// (a+1, b+-1), (a+2, b+-2). Those are a second passage that the model missed or a row of
/// look-alikes, which pairs alone cannot tell: doubtful, but for those that GNSS tells apart
/// (BorneOutByGnss).
[[nodiscard]] CrossCheck CheckPairs(const JobResults& results,
                                    const PairsOfJob& judged,
                                    const BorneOutByGnss& gnss);

}  // namespace orbweave
