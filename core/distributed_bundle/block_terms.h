// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/gauge.h"

namespace orbweave {

/// The terms of one block, by their indices in the whole problem, ascending.
struct BlockTerms {
  std::vector<uint32_t> observations{};
  std::vector<uint32_t> position_priors{};
  std::vector<uint32_t> direction_priors{};
  std::vector<uint32_t> bias_priors{};  ///< groups
};

/// Gives every term to one block; see DivideIntoBlocks.
[[nodiscard]] std::vector<BlockTerms> DivideTerms(const BundleProblem& problem,
                                                  const Gauge& gauge,
                                                  const std::vector<uint32_t>& owner_of_pose,
                                                  uint32_t num_blocks);

}  // namespace orbweave
