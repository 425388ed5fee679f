// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/parted_pairs.h"

#include <algorithm>

namespace orbweave {

std::vector<CrossingPair> PartedPairs(const ClusterProblem& problem,
                                      std::span<const Reconstruction> submodels) {
  std::vector<CrossingPair> parted;
  for (const TwoViewGeometry& geometry : problem.pairs) {
    const ImagePair& pair = geometry.pair;
    const auto has_both = [&](const Reconstruction& submodel) {
      return submodel.images.contains(pair.a) && submodel.images.contains(pair.b);
    };
    if (geometry.kind == TwoViewKind::kGeneral && std::ranges::none_of(submodels, has_both))
      parted.push_back({pair, geometry.b_from_a});
  }
  return parted;
}

}  // namespace orbweave
