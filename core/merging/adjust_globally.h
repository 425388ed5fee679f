// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/stage_context.h"
#include "core/bundle/adjust_bundle.h"
#include "core/merging/conclude_adjustment.h"
#include "core/merging/global_options.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

struct AdjustedBlocks {
  std::vector<WorldBlock> blocks{};
  std::vector<BlockSummary> summaries{};  ///< per block
  GlobalAdjustReport report{};            ///< without what ConcludeAdjustment finds
};

/// Adjusts and filters the blocks of one world in this process, on `context.num_threads` threads:
/// BeginAdjustment, SteerAdjustment and BlockWorker as they are when blocks are spread over many.
/// InvalidArgument: bundle.solver is Ceres and there are several blocks. Cancelled when asked to
/// stop.
[[nodiscard]] absl::StatusOr<AdjustedBlocks> AdjustBlocks(std::vector<WorldBlock> blocks,
                                                          const GlobalAdjustOptions& options,
                                                          const BundleOptions& bundle,
                                                          const StageContext& context);

struct GloballyAdjusted {
  Reconstruction reconstruction{};  ///< east-north-up metres when report.gnss.used
  GlobalAdjustReport report{};
};

/// A whole reconstruction in one process, as one block: georeferences robustly
/// (GeoreferenceReconstruction; ChooseLocalFrame where GNSS cannot carry a scale and must not bend
/// the model), then `rounds` times adjusts all poses and points with the given loss and robust GNSS
/// terms and filters (FilterBlock), and finishes with least squares, a last filter and the poses'
/// uncertainty. Loose images follow the frame but take no part. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<GloballyAdjusted> AdjustGlobally(Reconstruction reconstruction,
                                                              const ImageManifest& manifest,
                                                              const GlobalAdjustOptions& options,
                                                              const BundleOptions& bundle,
                                                              const StageContext& context);

}  // namespace orbweave
