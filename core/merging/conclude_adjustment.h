// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/merging/adjust_block.h"
#include "core/merging/certify_seams.h"
#include "core/merging/georeference_reconstruction.h"
#include "core/merging/global_options.h"
#include "core/merging/inspect_block.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// An adjusted world without its tracks.
struct ConcludedWorld {
  std::map<ImageId, RegisteredImage> images{};  ///< loose where nobody observes them any more
  Sim3 model_from_world{};  ///< identity where georeferenced; else into ChooseLocalFrame
  std::vector<SeamCertificate> seams{};  ///< in units of the model
  GlobalAdjustReport report{};
};

/// What the blocks of a world left behind, in their order, when the adjustment was over.
struct AdjustedWorld {
  std::vector<BlockSummary> summaries{};
  std::vector<BlockInspection> inspections{};
  GlobalAdjustReport report{};  ///< without what ConcludeAdjustment finds
};

/// What only the whole world tells: which images nobody observes any more (they become loose),
/// which ones their own observations do not place (JudgeSupport; they are no more in the world, for
/// AttachLooseImages to put where GNSS says), how GNSS fits
/// (JudgeGnss), residuals, the uncertainty of poses, how `seams` (of the partition) fit, cross
/// checks, and the frame of the model.
[[nodiscard]] ConcludedWorld ConcludeAdjustment(AdjustedWorld adjusted,
                                                const std::vector<Seam>& seams,
                                                const Georeference& georeference,
                                                const ImageManifest& manifest,
                                                const GlobalAdjustOptions& options);

/// The images of the model, in its frame.
[[nodiscard]] std::map<ImageId, RegisteredImage> ModelImages(const ConcludedWorld& world);

/// The tracks of the model, in its frame, one after the other: block by block those that a block
/// has for itself, then, by id, those that were split, made whole. Holds no more than one block and
/// the split tracks.
class TracksOfWorld {
 public:
  using Visit = std::function<void(const Track& track)>;

  explicit TracksOfWorld(const ConcludedWorld& world);

  void Add(WorldBlock block, const Visit& visit);
  /// After all blocks.
  void Finish(const Visit& visit);

 private:
  /// Takes off what images that are no more in the model saw.
  [[nodiscard]] bool IsSeen(Track& track) const;

  Sim3 model_from_world_;
  std::set<ImageId> observers_;
  std::map<uint32_t, Track> split_;
};

/// Both together.
[[nodiscard]] Reconstruction GatherWorld(const ConcludedWorld& world,
                                         std::vector<WorldBlock> blocks);

}  // namespace orbweave
