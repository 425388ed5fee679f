// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_seams/plan_seams.h"

namespace orbweave {

std::vector<std::vector<Digest>> PlanSeams(const Partition& partition,
                                           const std::vector<Digest>& boundaries) {
  std::vector<std::vector<Digest>> recipes;
  for (const Digest& boundary : boundaries) recipes.push_back({boundary});
  for (const Seam& seam : partition.seams)
    recipes[seam.cluster_a].push_back(boundaries[seam.cluster_b]);
  return recipes;
}

}  // namespace orbweave
