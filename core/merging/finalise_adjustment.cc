// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/finalise_adjustment.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "core/base/status.h"
#include "core/merging/checks/assess_world.h"
#include "core/merging/checks/check_attitudes.h"
#include "core/merging/checks/check_drive_motion.h"
#include "core/merging/checks/check_even_steps.h"
#include "core/merging/checks/check_gnss.h"
#include "core/merging/checks/check_headings.h"
#include "core/merging/checks/check_leans.h"
#include "core/merging/checks/check_missed_points.h"
#include "core/merging/checks/check_sequence_steps.h"
#include "core/merging/checks/check_vanished_steps.h"
#include "core/merging/georeference/choose_local_frame.h"
#include "core/merging/georeference/global_problem.h"
#include "core/merging/georeference/judge_gnss.h"

namespace orbweave {
namespace {

Reconstruction PosesOf(std::span<const SubproblemSummary> summaries) {
  Reconstruction poses;
  for (const SubproblemSummary& summary : summaries) {
    poses.images.insert(summary.owned_images.begin(), summary.owned_images.end());
  }
  return poses;
}

void MeasureResiduals(std::span<const SubproblemSummary> summaries, GlobalAdjustReport& report) {
  double sum_px = 0.0;
  double sum_px2 = 0.0;
  uint64_t count = 0;
  for (const SubproblemSummary& summary : summaries) {
    sum_px += summary.residual_px_sum;
    sum_px2 += summary.residual_px2_sum;
    for (const auto& [id, observations] : summary.observations_of_image) count += observations;
  }
  report.num_observations = count;
  if (count == 0) return;
  report.residual_px_mean = sum_px / static_cast<double>(count);
  report.residual_px_rms = std::sqrt(sum_px2 / static_cast<double>(count));
  ResidualPattern pattern;
  for (const SubproblemSummary& summary : summaries) pattern.Add(summary.pattern);
  report.pattern_px = pattern.LargestPx(report.residual_px_rms);
  report.checks.push_back(CheckResidualPattern(pattern, report.residual_px_rms));
}

/// The drives' biases, by group.
std::vector<Eigen::Vector3d> BiasesOf(std::span<const SubproblemSummary> summaries,
                                      size_t num_groups) {
  std::vector<Eigen::Vector3d> biases_m(num_groups, Eigen::Vector3d::Zero());
  for (const SubproblemSummary& summary : summaries) {
    for (const SubproblemBias& bias : summary.biases) biases_m[bias.group] = bias.value_m;
  }
  return biases_m;
}

SeamCertifier CertifierOf(const AdjustedWorld& adjusted, const std::vector<Seam>& seams) {
  std::set<uint32_t> clusters;
  for (const SubproblemSummary& summary : adjusted.summaries) {
    if (!summary.owned_images.empty()) clusters.insert(summary.cluster);
  }
  SeamCertifier certifier(seams, clusters);
  for (const SubproblemInspection& inspection : adjusted.inspections)
    certifier.Add(inspection.placements);
  return certifier;
}

using SupportsOfSubproblems = std::vector<std::vector<PatchSupport>>;
using SupportVerdicts = std::map<ImageId, SupportVerdict>;

/// Of images that any subproblem supports.
SupportVerdicts JudgeSupports(const SupportsOfSubproblems& of_subproblems) {
  std::map<ImageId, std::vector<PatchSupport>> supports;
  for (const std::vector<PatchSupport>& own : of_subproblems) AddSupport(own, supports);
  SupportVerdicts verdicts;
  for (const auto& [id, patches] : supports) verdicts[id] = JudgeSupport(patches);
  return verdicts;
}

/// Images that two witnesses have elsewhere which have nothing to do with each other: their own
/// GNSS position (JudgeGnss), and others that see from either side what they should see
/// (ImagesThatMissPoints), or the even steps of their drive, at an end of which they stand
/// (FindShortSteps). Hundreds of points that one neighbour alone shares may put an image there,
/// where houses repeat.
std::map<ImageId, std::string> FindMisplaced(const std::vector<SeenBetween>& seen_between,
                                             const GnssReport& gnss,
                                             const std::map<ImageId, RegisteredImage>& images,
                                             const ImageManifest& manifest) {
  std::map<ImageId, std::string> reasons;
  const auto by_gnss_too = [&](ImageId image) {
    return std::ranges::find(gnss.outliers, manifest.At(image).name) != gnss.outliers.end();
  };
  for (const ShortStep& step : FindShortSteps(images, manifest)) {
    if (!step.end || !by_gnss_too(*step.end)) continue;
    reasons[*step.end] = absl::StrFormat(
        "points put it elsewhere than its GNSS position does, and %.0f %% of a usual step from %s, "
        "its only neighbour: misplaced",
        100.0 * step.steps,
        manifest.At(step.end == step.from ? step.to : step.from).name);
  }
  for (const SeenBetween& count : ImagesThatMissPoints(seen_between, images)) {
    if (!by_gnss_too(count.image)) continue;
    reasons[count.image] = absl::StrFormat(
        "points put it elsewhere than its GNSS position does, and it sees %d of %d that others see "
        "from either side of there: misplaced",
        count.seen,
        count.asked);
  }
  return reasons;
}

/// Takes out what is misplaced and what its own observations do not place, until those of all that
/// are left do. `verdicts`: of `supports`.
absl::Status TakeOutWeak(const AdjustedWorld& adjusted,
                         SupportsOfSubproblems supports,
                         SupportVerdicts verdicts,
                         const std::map<ImageId, std::string>& misplaced,
                         const ImageManifest& manifest,
                         Reconstruction& poses,
                         GlobalAdjustReport& report) {
  const SupportVerdict unsupported = JudgeSupport({});
  std::set<ImageId> weak;
  for (const auto& [id, reason] : misplaced) {
    weak.insert(id);
    report.weak_images.push_back({manifest.At(id).name, reason});
  }
  for (size_t known = 0;; known = weak.size()) {
    for (const auto& [id, image] : poses.images) {
      if (image.loose || weak.contains(id)) continue;
      const auto found = verdicts.find(id);
      const SupportVerdict& verdict = found == verdicts.end() ? unsupported : found->second;
      if (!verdict.is_weak) continue;
      weak.insert(id);
      report.weak_images.push_back({manifest.At(id).name, verdict.reason});
    }
    if (weak.size() == known) break;
    for (size_t place = 0; place < supports.size(); ++place) {
      const bool is_touched = std::ranges::any_of(
          supports[place], [&](const PatchSupport& patch) { return weak.contains(patch.image); });
      if (!is_touched) continue;
      ORBWEAVE_ASSIGN_OR_RETURN(supports[place], adjusted.support_without(place, weak));
    }
    verdicts = JudgeSupports(supports);
  }
  for (const ImageId id : weak) poses.images.erase(id);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<FinalisedWorld> FinaliseAdjustment(AdjustedWorld adjusted,
                                                  const std::vector<Seam>& seams,
                                                  const Georeference& georeference,
                                                  const ImageManifest& manifest,
                                                  const GlobalAdjustOptions& options) {
  FinalisedWorld world{.report = std::move(adjusted.report)};
  const std::vector<SubproblemSummary>& summaries = adjusted.summaries;
  Reconstruction poses = PosesOf(summaries);
  GlobalProblem problem = MakeGlobalProblem(poses);
  if (georeference.enu_from_world)
    AddGnss(poses, manifest, georeference, options.gnss_bias_sigma_m, 1.0, problem);
  const std::vector<Eigen::Vector3d> biases_m =
      BiasesOf(summaries, problem.bundle.bias_sigma_m.size());
  const SeamCertifier certifier = CertifierOf(adjusted, seams);
  SupportsOfSubproblems supports;
  std::vector<Eigen::Vector3d> points_about;
  std::vector<SeenBetween> seen_between;
  for (const SubproblemInspection& inspection : adjusted.inspections) {
    supports.push_back(inspection.supports);
    std::ranges::copy(inspection.points_about, std::back_inserter(points_about));
    std::ranges::copy(inspection.seen_between, std::back_inserter(seen_between));
  }
  SupportVerdicts verdicts = JudgeSupports(supports);
  AssessedWorld assessed =
      AssessWorld(std::move(adjusted.inspections), verdicts, problem, biases_m, manifest);
  for (const auto& [id, uncertainty] : assessed.uncertainties)
    poses.images.at(id).uncertainty = uncertainty;
  WidenByDriveErrors(georeference, manifest, poses);
  world.report.uncertainty = std::move(assessed.report);
  std::ranges::copy(CheckGnss(problem, biases_m, georeference, manifest, points_about),
                    std::back_inserter(world.report.checks));
  std::map<ImageId, std::string> misplaced;
  if (georeference.enu_from_world) {
    const GnssReport gnss = JudgeGnss(problem, biases_m, manifest, poses.images);
    misplaced = FindMisplaced(seen_between, gnss, poses.images, manifest);
  }
  ORBWEAVE_RETURN_IF_ERROR(TakeOutWeak(adjusted,
                                       std::move(supports),
                                       std::move(verdicts),
                                       misplaced,
                                       manifest,
                                       poses,
                                       world.report));
  if (georeference.enu_from_world) {
    world.report.gnss = JudgeGnss(problem, biases_m, manifest, poses.images);
    world.report.gnss.deformation_m = georeference.deformation_m;
    world.report.adjustments.back().biases_m = biases_m;
  } else {
    world.report.gnss.reason = georeference.reason;
  }
  MeasureResiduals(summaries, world.report);
  if (!georeference.enu_from_world) world.model_from_world = ChooseLocalFrame(poses, manifest);
  const double sigma_factor = world.report.uncertainty.bearing_sigma_factor;
  world.seams = certifier.Finish(sigma_factor * sigma_factor);
  for (SeamCertificate& seam : world.seams) {
    seam.position_jump_m *= world.model_from_world.scale;
    seam.position_noise_m *= world.model_from_world.scale;
  }
  world.images = std::move(poses.images);
  const bool is_in_metres = georeference.enu_from_world.has_value();
  const std::map<ImageId, RegisteredImage> images = ModelImages(world);
  world.report.checks.push_back(CheckSequenceSteps(images, manifest, is_in_metres));
  world.report.checks.push_back(CheckEvenSteps(images, manifest));
  world.report.checks.push_back(CheckVanishedSteps(images, manifest));
  if (is_in_metres) world.report.checks.push_back(CheckDriveMotion(images, manifest));
  world.report.checks.push_back(CheckMissedPoints(seen_between, images, manifest));
  world.report.checks.push_back(CheckLeans(images, manifest));
  std::ranges::move(CheckAttitudes(images, manifest), std::back_inserter(world.report.checks));
  if (std::optional<CrossCheck> headings = CheckHeadings(images, manifest, is_in_metres))
    world.report.checks.push_back(*std::move(headings));
  return world;
}

std::map<ImageId, RegisteredImage> ModelImages(const FinalisedWorld& world) {
  return Transformed(world.model_from_world, Reconstruction{.images = world.images}).images;
}

TracksOfWorld::TracksOfWorld(const FinalisedWorld& world)
    : model_from_world_(world.model_from_world) {
  for (const auto& [id, image] : world.images) {
    if (!image.loose) observers_.insert(id);
  }
}

bool TracksOfWorld::IsSeen(Track& track) const {
  std::erase_if(track.observations,
                [&](const Observation& seen) { return !observers_.contains(seen.ref.image); });
  return track.observations.size() > 1;
}

void TracksOfWorld::Add(Subproblem subproblem, const Visit& visit) {
  for (Track& track : subproblem.scene.tracks) {
    if (!IsSeen(track)) continue;
    track.point_in_world = model_from_world_ * track.point_in_world;
    visit(track);
  }
  for (SplitTrack& track : subproblem.split) {
    Track& whole = split_[track.id];
    whole.point_in_world = model_from_world_ * track.part.point_in_world;
    whole.color = track.part.color;
    std::ranges::move(track.part.observations, std::back_inserter(whole.observations));
  }
}

void TracksOfWorld::Finish(const Visit& visit) {
  for (auto& [id, track] : split_) {
    if (!IsSeen(track)) continue;
    std::ranges::sort(track.observations, {}, &Observation::ref);
    visit(track);
  }
}

}  // namespace orbweave
