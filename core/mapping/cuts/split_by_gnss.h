// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/cluster_problem.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// A submodel in pieces where GNSS has it torn: where matches of neighbours show the direction from
/// one to the next and hardly a point that three panoramas see, pieces that are right by themselves
/// may stand many steps apart. Two images that have a point in common are torn apart when
/// they are more than twice as far from each other as GNSS allows, at the model's usual scale
/// s:
///   |C_b - C_a| > 2 s (|G_b - G_a| + 3 sigma),   s = median of |C_b - C_a| / |G_b - G_a|
/// with centres C, horizontal positions G and the sigma of their difference, s over those further
/// apart than that. Nearer than GNSS has them they are no such thing: a single position that is off
/// tears nothing. What common points hold together without torn ones is a piece; each keeps its
/// images, and its tracks as far as two of them see these.
///
/// Largest first, of equal ones that of the lowest image. One piece, the model as it is, where
/// nothing is torn or positions are missing.
[[nodiscard]] std::vector<Reconstruction> SplitByGnss(const ClusterProblem& problem,
                                                      Reconstruction model);

}  // namespace orbweave
