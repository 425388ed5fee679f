// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/artifacts/check_adjustment.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/artifacts/check_bounds.h"

namespace orbweave {
namespace {

using Work = LmRequest::Work;

bool IsFirm(const Subproblem& subproblem, const SubproblemImage& image) {
  const auto found = subproblem.scene.images.find(image.id);
  return found != subproblem.scene.images.end() && !found->second.loose;
}

size_t NumPoses(const Subproblem& subproblem) {
  return static_cast<size_t>(std::ranges::count_if(
      subproblem.images, [&](const SubproblemImage& image) { return IsFirm(subproblem, image); }));
}

/// Those that TermsOf finds.
std::vector<SeparatorId> SeparatorsOf(const Subproblem& subproblem) {
  std::vector<SeparatorId> separators;
  for (const SubproblemImage& image : subproblem.images) {
    if (image.is_separator && IsFirm(subproblem, image))
      separators.push_back({SeparatorId::Kind::kPose, image.id.value});
  }
  for (const SubproblemBias& bias : subproblem.biases) {
    if (bias.is_separator) separators.push_back({SeparatorId::Kind::kBias, bias.group});
  }
  for (const SplitTrack& track : subproblem.split)
    separators.push_back({SeparatorId::Kind::kPoint, track.id});
  return separators;
}

size_t NumPoints(const std::vector<SeparatorId>& separators) {
  return static_cast<size_t>(
      std::ranges::count(separators, SeparatorId::Kind::kPoint, &SeparatorId::kind));
}

/// Of a system that could be solved.
absl::Status CheckVariables(const SeparatorSystem& system,
                            const std::vector<SeparatorId>& separators) {
  if (!system.is_definite || system.variables == separators) return absl::OkStatus();
  return DoesNotFit("a block replies with equations of other variables than its own");
}

absl::Status CheckReply(const WorldProgress& world, size_t block, const LmReply& reply) {
  const bool begins = world.asked == Work::kEvaluate || world.asked == Work::kFilter;
  if (begins) return CheckVariables(reply.system, reply.separators);
  const std::vector<SeparatorId>& separators = world.path.separators_of_subproblem[block];
  if (world.asked == Work::kLinearise) return CheckVariables(reply.system, separators);
  if (reply.trial.retained_points.size() == NumPoints(separators)) return absl::OkStatus();
  return DoesNotFit("a block replies with costs of other points than its own");
}

/// What a world knows of the rounds before.
absl::Status CheckPath(const WorldProgress& world, size_t num_blocks, int rounds) {
  const bool is_last = world.phase == rounds + 1;
  if (world.phase > rounds + 1 || world.is_done != is_last ||
      (world.is_done && world.asked != Work::kFilter)) {
    return DoesNotFit(absl::StrCat("a world is in phase ", world.phase, " of ", rounds + 1));
  }
  if (world.asked == Work::kEvaluate || world.asked == Work::kFilter) return absl::OkStatus();
  if (world.path.separators_of_subproblem.size() != num_blocks)
    return DoesNotFit("a world has other blocks than before");
  if (world.report.adjustments.empty() || world.report.accepted_costs.empty())
    return DoesNotFit("a world takes a step before the first");
  return absl::OkStatus();
}

/// Images of a world that its subproblems own.
struct WorldImages {
  std::set<ImageId> firm{};
  std::set<uint32_t> drives{};  ///< of firm images with a position
};

absl::StatusOr<WorldImages> ImagesOf(const AdjustedWorld& adjusted, const ImageManifest& manifest) {
  WorldImages images;
  for (const SubproblemSummary& summary : adjusted.summaries) {
    for (const auto& [id, image] : summary.owned_images) {
      ORBWEAVE_RETURN_IF_ERROR(CheckImages(std::array{id}, manifest, "a block"));
      if (image.loose) continue;
      images.firm.insert(id);
      if (manifest.At(id).prior.position_in_enu) images.drives.insert(manifest.At(id).drive);
    }
  }
  return images;
}

absl::Status CheckInspection(const SubproblemInspection& inspection, const WorldImages& images) {
  const auto is_firm = [&](ImageId id) { return images.firm.contains(id); };
  const auto is_known = [&](const SeparatorId& id) {
    return id.kind != SeparatorId::Kind::kPose || is_firm(ImageId(id.index));
  };
  if (!std::ranges::all_of(inspection.bearings.variables, is_known))
    return DoesNotFit("a block has bearings of an image that no block has placed");
  if ((inspection.held && !is_firm(*inspection.held)) ||
      (inspection.farthest && !is_firm(*inspection.farthest)))
    return DoesNotFit("a block holds an image that no block has placed");
  return absl::OkStatus();
}

/// Drives are numbered in the whole world (AddGnss), where there are several.
absl::Status CheckBiases(const SubproblemSummary& summary,
                         const WorldImages& images,
                         const Georeference& georeference) {
  const bool has_biases = georeference.enu_from_world && images.drives.size() > 1;
  for (const SubproblemBias& bias : summary.biases) {
    ORBWEAVE_RETURN_IF_ERROR(CheckNumber(
        bias.group, has_biases ? images.drives.size() : 0, "a block has the bias of drive"));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status CheckState(const Subproblem& subproblem, const EvaluatedState& state) {
  const size_t tracks = subproblem.scene.tracks.size();
  const size_t split = subproblem.split.size();
  const BundleState& variables = state.variables;
  if (variables.poses.size() == NumPoses(subproblem) && variables.points.size() == tracks + split &&
      variables.biases.size() == subproblem.biases.size() &&
      state.costs.per_point.size() == tracks && state.retained_points_before.size() == split) {
    return absl::OkStatus();
  }
  return DoesNotFit("a state is of another block");
}

absl::Status CheckRequest(const Subproblem& subproblem, const LmRequest& request, bool has_state) {
  if (!has_state && request.work != Work::kEvaluate)
    return DoesNotFit("a block is to go on from no state");
  if (request.work != Work::kTrial || request.step.variables == SeparatorsOf(subproblem))
    return absl::OkStatus();
  return DoesNotFit("a block is to step other variables than its own");
}

absl::Status CheckReplies(const WorldProgress& world,
                          std::span<const SubproblemResult> results,
                          const GlobalAdjustOptions& options) {
  if (results.empty()) return DoesNotFit("a world without blocks");
  ORBWEAVE_RETURN_IF_ERROR(CheckPath(world, results.size(), options.rounds));
  if (world.is_done) return absl::OkStatus();
  for (size_t b = 0; b < results.size(); ++b)
    ORBWEAVE_RETURN_IF_ERROR(CheckReply(world, b, results[b].reply));
  return absl::OkStatus();
}

absl::Status CheckFinished(const AdjustmentProgress& progress,
                           const std::vector<JoinedWorld>& worlds) {
  if (progress.worlds.size() != worlds.size())
    return DoesNotFit(absl::StrCat(progress.worlds.size(), " worlds of ", worlds.size()));
  for (uint32_t world = 0; world < worlds.size(); ++world) {
    const auto blocks = static_cast<size_t>(
        std::ranges::count(progress.subproblems, world, &SubproblemPlace::world));
    if (blocks != worlds[world].num_subproblems)
      return DoesNotFit(absl::StrCat("world ", world, " has other blocks than it was divided in"));
    if (progress.is_asked[world] != 0)
      return DoesNotFit(absl::StrCat("world ", world, " is not adjusted yet"));
    const bool has_positions = worlds[world].georeference.enu_from_world.has_value();
    if (has_positions && progress.worlds[world].report.adjustments.empty())
      return DoesNotFit(absl::StrCat("world ", world, " was never adjusted"));
  }
  return absl::OkStatus();
}

absl::Status CheckAdjustedWorld(const AdjustedWorld& adjusted,
                                const Georeference& georeference,
                                const ImageManifest& manifest) {
  ORBWEAVE_ASSIGN_OR_RETURN(const WorldImages images, ImagesOf(adjusted, manifest));
  for (const SubproblemSummary& summary : adjusted.summaries)
    ORBWEAVE_RETURN_IF_ERROR(CheckBiases(summary, images, georeference));
  for (const SubproblemInspection& inspection : adjusted.inspections)
    ORBWEAVE_RETURN_IF_ERROR(CheckInspection(inspection, images));
  return absl::OkStatus();
}

}  // namespace orbweave
