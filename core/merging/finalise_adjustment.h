// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <vector>

#include "absl/status/statusor.h"
#include "core/geometry/sim3.h"
#include "core/merging/checks/certify_seams.h"
#include "core/merging/checks/inspect_subproblem.h"
#include "core/merging/georeference/georeference.h"
#include "core/partitioned_ba/global_options.h"
#include "core/partitioned_ba/subproblem_solver.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// An adjusted world without its tracks.
struct FinalisedWorld {
  std::map<ImageId, RegisteredImage> images{};
  Sim3 model_from_world{};  ///< identity where georeferenced; else into ChooseLocalFrame
  std::vector<SeamCertificate> seams{};  ///< in units of the model
  GlobalAdjustReport report{};
};

/// What the subproblems of a world left behind, in their order, when the adjustment was over.
struct AdjustedWorld {
  std::vector<SubproblemSummary> summaries{};
  std::vector<SubproblemInspection> inspections{};
  GlobalAdjustReport report{};  ///< without what FinaliseAdjustment finds
  /// SupportOf the subproblem at a place, as if some images had seen nothing.
  std::function<absl::StatusOr<std::vector<PatchSupport>>(size_t place,
                                                          const std::set<ImageId>& without)>
      support_without{};
};

/// What only the whole world tells: which images their own observations do not place (JudgeSupport;
/// they are no more in the world, for AttachLooseImages to put where GNSS says), nor once those
/// that do not are left out, as what two see alone is no support where one of them goes, which ones
/// stand neither where GNSS has them nor where others look (ImagesThatMissPoints; left out alike),
/// how GNSS fits the others (JudgeGnss), residuals, the uncertainty of poses, how `seams` (of the
/// partition) fit, cross checks, and the frame of the model. Errors are those of `support_without`.
[[nodiscard]] absl::StatusOr<FinalisedWorld> FinaliseAdjustment(AdjustedWorld adjusted,
                                                                const std::vector<Seam>& seams,
                                                                const Georeference& georeference,
                                                                const ImageManifest& manifest,
                                                                const GlobalAdjustOptions& options);

/// The images of the model, in its frame.
[[nodiscard]] std::map<ImageId, RegisteredImage> ModelImages(const FinalisedWorld& world);

/// The tracks of the model, in its frame, one after the other: subproblem by subproblem those that
/// a subproblem has for itself, then, by id, those that were split, made whole. Holds no more than
/// one subproblem and the split tracks.
class TracksOfWorld {
 public:
  using Visit = std::function<void(const Track& track)>;

  explicit TracksOfWorld(const FinalisedWorld& world);

  void Add(Subproblem subproblem, const Visit& visit);
  /// After all subproblems.
  void Finish(const Visit& visit);

 private:
  /// Takes off what images that are no more in the model saw.
  [[nodiscard]] bool IsSeen(Track& track) const;

  Sim3 model_from_world_;
  std::set<ImageId> observers_;
  std::map<uint32_t, Track> split_;
};

}  // namespace orbweave
