// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/bundle/bundle_options.h"
#include "core/merging/checks/inspect_subproblem.h"
#include "core/merging/divide_world.h"
#include "core/merging/finalise_adjustment.h"
#include "core/merging/georeference/georeference.h"
#include "core/merging/georeference/georeference_reconstruction.h"
#include "core/partitioned_ba/adjust_subproblems.h"

namespace orbweave::testing {

// The model that the stages hand on in parts.
inline Reconstruction GatherWorld(const FinalisedWorld& world,
                                  std::vector<Subproblem> subproblems) {
  Reconstruction model{.images = ModelImages(world)};
  const auto take = [&model](const Track& track) { model.tracks.push_back(track); };
  TracksOfWorld tracks(world);
  for (Subproblem& subproblem : subproblems) tracks.Add(std::move(subproblem), take);
  tracks.Finish(take);
  model.SortTracks();
  return model;
}

struct GloballyAdjusted {
  Reconstruction reconstruction{};  // east-north-up metres when report.gnss.used
  GlobalAdjustReport report{};
};

/// What inspections say of images, to be made worse than it is.
using SpoilSupports = std::function<void(std::vector<PatchSupport>& supports)>;

// All that the stages do to a world after the merge, for one that is a single subproblem.
inline absl::StatusOr<GloballyAdjusted> AdjustGlobally(Reconstruction reconstruction,
                                                       const ImageManifest& manifest,
                                                       const GlobalAdjustOptions& options,
                                                       const BundleOptions& bundle,
                                                       const StageContext& context,
                                                       const SpoilSupports& spoil = {}) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const Georeference georeference,
      GeoreferenceReconstruction(reconstruction, manifest, options.gnss, context));
  if (georeference.enu_from_world)
    reconstruction = Transformed(*georeference.enu_from_world, std::move(reconstruction));
  std::map<ImageId, uint32_t> one_owner;
  for (const auto& [id, image] : reconstruction.images) one_owner[id] = 0;
  ORBWEAVE_ASSIGN_OR_RETURN(AdjustedSubproblems adjusted,
                            AdjustSubproblems(DivideWorld(std::move(reconstruction),
                                                          0,
                                                          one_owner,
                                                          georeference,
                                                          manifest,
                                                          options.gnss_bias_sigma_m),
                                              options,
                                              bundle,
                                              context));
  AdjustedWorld left{.summaries = std::move(adjusted.summaries),
                     .report = std::move(adjusted.report)};
  for (const Subproblem& subproblem : adjusted.subproblems)
    left.inspections.push_back(InspectSubproblem(subproblem, context.num_threads));
  for (SubproblemInspection& inspection : left.inspections) {
    if (spoil) spoil(inspection.supports);
  }
  left.support_without = [&](size_t place, const std::set<ImageId>& without) {
    return SupportOf(adjusted.subproblems[place], without);
  };
  ORBWEAVE_ASSIGN_OR_RETURN(
      const FinalisedWorld world,
      FinaliseAdjustment(std::move(left), {}, georeference, manifest, options));
  return GloballyAdjusted{GatherWorld(world, std::move(adjusted.subproblems)), world.report};
}

}  // namespace orbweave::testing
