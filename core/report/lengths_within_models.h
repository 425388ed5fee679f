// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/report/job_results.h"
#include "core/report/model_of_images.h"

namespace orbweave {

/// What clusters say of lengths (their pair_lengths or gap_lengths) that lie within one model, each
/// place once and in order: as that cluster has it which `is_preferred(one, other)` to the others.
template <typename Length, typename IsPreferred>
std::vector<Length> LengthsWithinModels(const JobResults& results,
                                        std::vector<Length> ClusterSummary::*lengths,
                                        ImagePair Length::*place,
                                        const IsPreferred& is_preferred) {
  const std::vector<int> model_of_image = ModelOfImages(results);
  std::map<ImagePair, Length> preferred;
  for (const ClusterSummary& cluster : results.clusters) {
    for (const Length& length : cluster.*lengths) {
      if (!AreOfOneModel(model_of_image, length.*place)) continue;
      const auto [known, is_new] = preferred.try_emplace(length.*place, length);
      if (!is_new && is_preferred(length, known->second)) known->second = length;
    }
  }
  std::vector<Length> sorted;
  for (const auto& [where, length] : preferred) sorted.push_back(length);
  return sorted;
}

}  // namespace orbweave
