// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/merging/alignment/align_options.h"
#include "core/merging/alignment/align_submodels.h"
#include "core/merging/alignment/alignment.h"

namespace orbweave::testing {

// FitSeams cluster by cluster. `submodels`: by cluster and submodel.
inline absl::StatusOr<std::vector<SeamsOfCluster>> FitAllSeams(std::span<const Submodel> submodels,
                                                               const AlignOptions& options = {},
                                                               const StageContext& context = {}) {
  std::vector<SeamsOfCluster> clusters;
  while (!submodels.empty()) {
    const auto end = std::ranges::find_if(submodels, [&](const Submodel& submodel) {
      return submodel.cluster != submodels.front().cluster;
    });
    const auto count = static_cast<size_t>(end - submodels.begin());
    ORBWEAVE_ASSIGN_OR_RETURN(
        clusters.emplace_back(),
        FitSeams(submodels.first(count), submodels.subspan(count), options.max_error_px, context));
    submodels = submodels.subspan(count);
  }
  return clusters;
}

// And then AlignSubmodels.
inline absl::StatusOr<Alignment> AlignAll(std::span<const Submodel> submodels,
                                          const AlignOptions& options = {},
                                          const StageContext& context = {}) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<SeamsOfCluster> clusters,
                            FitAllSeams(submodels, options, context));
  return AlignSubmodels(clusters, options, context);
}

}  // namespace orbweave::testing
