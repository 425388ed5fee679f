// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/mapping/lengths/pair_length.h"
#include "core/scene/ids.h"
#include "core/scene/reconstruction.h"
#include "core/scene/view_graph.h"

namespace orbweave {

struct NotRegistered {
  ImageId image{};
  std::string reason{};
};

struct ClusterReconstruction {
  /// Largest first; an image is in at most one. Each in its own frame and scale.
  std::vector<Reconstruction> submodels{};
  std::vector<NotRegistered> not_registered{};
  std::vector<ImagePair> contradicted_pairs{};  ///< by the submodels; JudgePairs
  std::vector<ImagePair> explained_pairs{};
  std::vector<CrossingPair> parted_pairs{};  ///< between its submodels; PartedPairs
  std::vector<PairLength> pair_lengths{};    ///< of the submodels; MeasurePairLengths
  std::vector<GapLength> gap_lengths{};      ///< MeasureGapLengths
  int num_joined = 0;                        ///< submodels fewer, since bridges joined them
  int num_global_adjustments = 0;
  int num_local_adjustments = 0;
  double residual_rms_px = 0.0;
  bool started_globally = false;  ///< the largest submodel
  std::string start_remark{};     ///< why not globally, or what speaks against it; empty: nothing
};

}  // namespace orbweave
