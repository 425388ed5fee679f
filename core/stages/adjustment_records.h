// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/digest.h"
#include "core/merging/conclude_adjustment.h"
#include "core/merging/join_submodels.h"
#include "core/merging/steer_adjustment.h"

/// What the stages of the distributed global adjustment hand on. Bulk is named by digest.

namespace orbweave {

/// All that one block is put together from.
struct AssembleRecipe {
  JoinedBlock joined{};
  Digest cluster_result{};
  std::vector<ImageId> shared{};  ///< images of the cluster that other clusters have too, sorted
};

/// One piece of work for one block.
struct BlockTask {
  Digest block{};
  Digest state{};  ///< zero: none yet
  BlockOrder order{};
};

struct BlockResult {
  BlockAnswer answer{};
  Digest block{};  ///< zero: as it was
  Digest state{};  ///< zero: none
  /// Of the last order alone: what the adjusted block has to say about its world.
  Digest inspection{};
};

/// A block's place in the adjustment and where it stands.
struct BlockPlace {
  uint32_t world = 0;
  Digest block{};
  Digest state{};          ///< the one that counts
  Digest trial{};          ///< where the last step led
  BlockSummary summary{};  ///< of a world that is done ...
  Digest inspection{};     ///< ... too: a BlockInspection
};

/// What is known between two rounds.
struct AdjustmentProgress {
  std::vector<WorldPath> worlds{};
  std::vector<uint8_t> is_asked{};   ///< per world: its blocks are at work
  std::vector<BlockPlace> blocks{};  ///< sorted by (world, cluster)
};

/// The result of the sparse line, without its tracks: those are in the blocks.
struct ConcludedModel {
  std::vector<ConcludedWorld> worlds{};       ///< most images first
  std::vector<std::vector<Digest>> blocks{};  ///< per world: WorldBlocks
};

}  // namespace orbweave
