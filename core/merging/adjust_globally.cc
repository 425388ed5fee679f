// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/adjust_globally.h"

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/merging/choose_local_frame.h"
#include "core/merging/filter_observations.h"
#include "core/merging/georeference_reconstruction.h"
#include "core/merging/global_problem.h"
#include "core/merging/judge_gnss.h"

namespace orbweave {
namespace {

absl::StatusOr<Georeference> Georeferenced(const Reconstruction& reconstruction,
                                           const ImageManifest& manifest,
                                           GnssUse use,
                                           const StageContext& context) {
  if (use == GnssUse::kOff) return Georeference{.reason = "switched off"};
  return GeoreferenceReconstruction(reconstruction, manifest, context);
}

void Filter(const ImageManifest& manifest,
            const GlobalAdjustOptions& options,
            GloballyAdjusted& model) {
  const double min_angle_rad = options.min_angle_deg * std::numbers::pi / 180.0;
  FilteredReconstruction filtered = FilterObservations(
      std::move(model.reconstruction), manifest, options.max_error_px, min_angle_rad);
  model.reconstruction = std::move(filtered.reconstruction);
  model.report.removed_observations += filtered.removed_observations;
  model.report.removed_tracks += filtered.removed_tracks;
}

absl::Status AdjustAndFilter(const ImageManifest& manifest,
                             const Georeference& georeference,
                             const GlobalAdjustOptions& options,
                             const BundleOptions& bundle_options,
                             const StageContext& context,
                             GloballyAdjusted& model) {
  GlobalProblem problem = MakeGlobalProblem(model.reconstruction);
  const bool uses_gnss = georeference.enu_from_world.has_value();
  if (uses_gnss) {
    AddGnss(model.reconstruction, manifest, georeference, options.gnss_bias_sigma_m, problem);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const BundleReport report,
                            AdjustBundle(problem.bundle, bundle_options, context));
  model.reconstruction = WithPosesAndPoints(problem, std::move(model.reconstruction));
  if (uses_gnss) model.report.gnss = JudgeGnss(problem, report.biases_m, manifest);
  model.report.adjustments.push_back(report);
  Filter(manifest, options, model);
  return absl::OkStatus();
}

void MeasureResiduals(const ImageManifest& manifest, GloballyAdjusted& model) {
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const Track& track : model.reconstruction.tracks) {
    for (const Observation& seen : track.observations) {
      const Rigid3& cam_from_world = model.reconstruction.images.at(seen.ref.image).cam_from_world;
      const double error_rad = BearingError(cam_from_world, track.point_in_world, seen.bearing);
      const double error_px = manifest.At(seen.ref.image).camera.PixelsFromAngle(error_rad);
      sum += error_px;
      sum_of_squares += error_px * error_px;
    }
  }
  const auto n = static_cast<double>(model.reconstruction.NumObservations());
  if (n == 0.0) return;
  model.report.residual_px_mean = sum / n;
  model.report.residual_px_rms = std::sqrt(sum_of_squares / n);
}

// An image that lost all its observations is where its neighbours and GNSS put it.
void LoosenUnobserved(const ImageManifest& manifest, GloballyAdjusted& model) {
  std::set<ImageId> observed;
  for (const Track& track : model.reconstruction.tracks) {
    for (const Observation& seen : track.observations) observed.insert(seen.ref.image);
  }
  for (auto& [id, image] : model.reconstruction.images) {
    if (image.loose || observed.contains(id)) continue;
    image.loose = true;
    model.report.unobserved_images.push_back(manifest.At(id).name);
  }
}

}  // namespace

absl::StatusOr<GloballyAdjusted> AdjustGlobally(Reconstruction reconstruction,
                                                const ImageManifest& manifest,
                                                const GlobalAdjustOptions& options,
                                                const BundleOptions& bundle_options,
                                                const StageContext& context) {
  GloballyAdjusted model{.reconstruction = std::move(reconstruction)};
  ORBWEAVE_ASSIGN_OR_RETURN(const Georeference georeference,
                            Georeferenced(model.reconstruction, manifest, options.gnss, context));
  model.report.gnss.reason = georeference.reason;
  if (georeference.enu_from_world) {
    model.reconstruction =
        Transformed(*georeference.enu_from_world, std::move(model.reconstruction));
  }

  const auto num_rounds = static_cast<uint64_t>(options.rounds) + 1;
  for (int round = 0; round < options.rounds; ++round) {
    context.Report(static_cast<uint64_t>(round), num_rounds, "adjustments");
    ORBWEAVE_RETURN_IF_ERROR(
        AdjustAndFilter(manifest, georeference, options, bundle_options, context, model));
  }
  BundleOptions least_squares = bundle_options;
  least_squares.loss = BundleLoss::kLeastSquares;
  context.Report(num_rounds - 1, num_rounds, "adjustments");
  ORBWEAVE_RETURN_IF_ERROR(
      AdjustAndFilter(manifest, georeference, options, least_squares, context, model));
  context.Report(num_rounds, num_rounds, "adjustments");

  LoosenUnobserved(manifest, model);
  MeasureResiduals(manifest, model);
  if (!georeference.enu_from_world) {
    const Sim3 local_from_world = ChooseLocalFrame(model.reconstruction, manifest);
    model.reconstruction = Transformed(local_from_world, std::move(model.reconstruction));
  }
  return model;
}

}  // namespace orbweave
