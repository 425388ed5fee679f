// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstruct_submodel.h"

#include <algorithm>

#include "core/mapping/adjustment/level_cameras.h"
#include "core/mapping/checks/borne_out_images.h"
#include "core/mapping/checks/compare_models.h"
#include "core/mapping/growth/find_seed_pairs.h"
#include "core/mapping/growth/initialise_from_pair.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/reconstruct_globally.h"

namespace orbweave {
namespace {

constexpr int kMaxFailuresPerImage = 2;
/// Of contested models so many are grown, and up to twice as many while they hold so many images
/// together: of rendered streets with houses that repeat, 12 m apart, one seed in two to five came
/// to one that was right.
constexpr int kGrownModels = 5;
constexpr uint32_t kGrownImages = 300;
/// A model of this share of the images that its seed's matches reach is taken for good.
constexpr double kGoodShare = 0.5;
/// The same for a model begun with all images at once, as seeds may do better.
constexpr double kNearlyAll = 0.9;
/// A model from seeds that leaves out a larger share of what its matches reach has a competitor
/// that begins with all images at once.
constexpr double kLeftOut = 0.02;
/// By so much more that one must hold, as it may be less right in detail.
constexpr double kClearlyMore = 0.05;

int MostGrownModels(const CorrespondenceGraph& graph) {
  const auto num_models = static_cast<int>(kGrownImages / std::max(graph.NumImages(), 1U));
  return std::clamp(num_models, kGrownModels, 2 * kGrownModels);
}

/// Number of available images that matches connect with `start`.
uint32_t CountReachable(const CorrespondenceGraph& graph,
                        std::span<const uint8_t> available,
                        ImageSlot start) {
  std::vector<uint8_t> reached(graph.NumImages(), 0);
  std::vector<ImageSlot> images = {start};
  reached[start] = 1;
  for (size_t i = 0; i < images.size(); ++i) {
    for (const uint32_t p : graph.pairs_of_image[images[i]]) {
      const LinkedPair& pair = graph.pairs[p];
      const ImageSlot other = pair.a == images[i] ? pair.b : pair.a;
      if (reached[other] != 0 || available[other] == 0) continue;
      reached[other] = 1;
      images.push_back(other);
    }
  }
  return static_cast<uint32_t>(images.size());
}

/// Which images seeds failed in, or small models cover already; or in which one began that grew,
/// when another is wanted.
class SpentSeeds {
 public:
  explicit SpentSeeds(uint32_t num_images) : failures_(num_images, 0), covered_(num_images, 0) {}

  [[nodiscard]] bool IsSpent(const LinkedPair& pair) const {
    return failures_[pair.a] >= kMaxFailuresPerImage || failures_[pair.b] >= kMaxFailuresPerImage ||
           (covered_[pair.a] != 0 && covered_[pair.b] != 0);
  }
  void NoteFailure(const LinkedPair& pair) {
    ++failures_[pair.a];
    ++failures_[pair.b];
  }
  void NoteModel(const MappingState& state) {
    for (const ImageSlot image : state.Registered()) covered_[image] = 1;
  }
  /// From now on only where no seed was tried.
  void WantOthers() {
    std::ranges::fill(covered_, 0);
    for (int& failures : failures_) failures = failures > 0 ? kMaxFailuresPerImage : 0;
  }

 private:
  std::vector<int> failures_;
  std::vector<uint8_t> covered_;
};

/// Grows models from seed pairs and keeps the best, or the one that `result` holds already. Where
/// pairs contest a large one, other seeds may come to a better one.
absl::Status GrowFromSeeds(const ClusterProblem& problem,
                           const CorrespondenceGraph& graph,
                           std::span<const uint8_t> available,
                           const MappingOptions& options,
                           RegistrationLog& log,
                           const StageContext& context,
                           SubmodelResult& result) {
  SpentSeeds spent(graph.NumImages());
  int tried = 0;
  int grown = 0;
  for (const uint32_t p : FindSeedPairs(problem, graph, available, options)) {
    if (tried >= options.max_seeds || grown >= MostGrownModels(graph)) break;
    const LinkedPair& pair = graph.pairs[p];
    if (spent.IsSpent(pair)) continue;
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    ++tried;
    MappingState state = LevelState(problem, graph, options);
    ORBWEAVE_ASSIGN_OR_RETURN(const bool started,
                              InitialiseFromPair(state, pair, options, context));
    if (!started) {
      spent.NoteFailure(pair);
      continue;
    }
    ++grown;
    RegistrationLog own_log = log;
    ResetAttempts(own_log);
    ORBWEAVE_ASSIGN_OR_RETURN(const GrowthReport growth,
                              GrowSubmodel(state, available, options, own_log, context));
    result.growth.num_local_adjustments += growth.num_local_adjustments;
    result.growth.num_global_adjustments += growth.num_global_adjustments;
    spent.NoteFailure(pair);
    spent.NoteModel(state);
    const bool is_large =
        BorneOutImages(state) >= kGoodShare * CountReachable(graph, available, pair.a);
    std::optional<bool> asked;
    if (is_large && ScheduleOf(options).relaxes_registration) asked = IsContested(state, options);
    const bool is_contested = asked.value_or(false);
    if (!result.state || IsBetterModel(state, *result.state, options)) {
      result.state.emplace(std::move(state));
      result.started_globally = false;
      result.is_contested = asked;
      log = own_log;
    }
    if (is_large && !is_contested) break;
    if (is_contested) spent.WantOthers();
  }
  return absl::OkStatus();
}

/// Begins with all images at once; true when that settles the matter.
absl::StatusOr<bool> GrowGlobally(const ClusterProblem& problem,
                                  const CorrespondenceGraph& graph,
                                  std::span<const uint8_t> available,
                                  const MappingOptions& options,
                                  RegistrationLog& log,
                                  const StageContext& context,
                                  SubmodelResult& result) {
  ResetAttempts(log);
  ORBWEAVE_ASSIGN_OR_RETURN(
      GlobalModel model,
      ReconstructGlobally(problem, graph, available, GlobalStart::kPairs, options, log, context));
  result.growth = model.growth;
  result.start_remark = model.fault;
  const bool is_forced = options.start == MappingStart::kGlobal;
  if (!model.state || model.state->Registered().empty()) return false;
  if (!model.fault.empty() && !is_forced) return false;
  const auto size = model.state->Registered().size();
  const uint32_t reachable = CountReachable(graph, available, model.state->Registered().front());
  result.state.emplace(std::move(*model.state));
  result.started_globally = true;
  if (static_cast<double>(size) >= kNearlyAll * reachable) return true;
  if (result.start_remark.empty()) {
    result.start_remark =
        std::to_string(size) + " of " + std::to_string(reachable) + " images stay registered";
  }
  return is_forced;
}

/// Whether the model lacks images that its matches reach.
bool LeavesImagesOut(const CorrespondenceGraph& graph,
                     std::span<const uint8_t> available,
                     const MappingState& state) {
  const auto size = static_cast<double>(state.Registered().size());
  const uint32_t reachable = CountReachable(graph, available, state.Registered().front());
  return size < (1.0 - kLeftOut) * reachable;
}

/// Whether a model of all images at once is to be had instead of one from seeds: GNSS does not
/// speak against it, and it holds clearly more where that leaves images out; where it leaves none
/// out, more has to speak for it, and that is not GNSS, as it began with its positions. Begun on
/// positions it need only be the better one: the steps of pairs are right there or wrong together.
bool Surpasses(const MappingState& global,
               GlobalStart start,
               const MappingState& kept,
               const CorrespondenceGraph& graph,
               std::span<const uint8_t> available,
               const MappingOptions& options) {
  if (start == GlobalStart::kPositions) return IsBetterModel(global, kept, options);
  if (IsLikedByGnss(kept, global, options)) return false;
  if (LeavesImagesOut(graph, available, kept))
    return BorneOutImages(global) > (1.0 + kClearlyMore) * BorneOutImages(kept);
  return global.Registered().size() >= kept.Registered().size() &&
         SpeaksMoreFor(global, kept, options);
}

/// Where seeds leave images out, or pairs contest their model: all at once, if that is sound and
/// holds more, or is the better one of the two.
absl::Status CompeteGlobally(const ClusterProblem& problem,
                             const CorrespondenceGraph& graph,
                             std::span<const uint8_t> available,
                             GlobalStart start,
                             const MappingOptions& options,
                             RegistrationLog& log,
                             const StageContext& context,
                             SubmodelResult& result) {
  RegistrationLog own_log = log;
  ResetAttempts(own_log);
  ORBWEAVE_ASSIGN_OR_RETURN(
      GlobalModel model,
      ReconstructGlobally(problem, graph, available, start, options, own_log, context));
  result.growth.num_local_adjustments += model.growth.num_local_adjustments;
  result.growth.num_global_adjustments += model.growth.num_global_adjustments;
  if (!model.state || !model.fault.empty()) return absl::OkStatus();
  if (result.state && !Surpasses(*model.state, start, *result.state, graph, available, options))
    return absl::OkStatus();
  result.state.emplace(std::move(*model.state));
  result.started_globally = true;
  log = std::move(own_log);
  return absl::OkStatus();
}

bool HasContestedState(const SubmodelResult& result, const MappingOptions& options) {
  return result.is_contested ? *result.is_contested : IsContested(*result.state, options);
}

}  // namespace

absl::StatusOr<SubmodelResult> ReconstructSubmodel(const ClusterProblem& problem,
                                                   const CorrespondenceGraph& graph,
                                                   std::span<const uint8_t> available,
                                                   const MappingOptions& options,
                                                   RegistrationLog& log,
                                                   const StageContext& context) {
  SubmodelResult result;
  if (ScheduleOf(options).start != MappingStart::kIncremental) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        const bool is_settled,
        GrowGlobally(problem, graph, available, options, log, context, result));
    if (is_settled) return result;
  }
  ORBWEAVE_RETURN_IF_ERROR(GrowFromSeeds(problem, graph, available, options, log, context, result));
  const bool may_compete = ScheduleOf(options).start == MappingStart::kIncremental &&
                           ScheduleOf(options).relaxes_registration;
  if (may_compete && (!result.state || LeavesImagesOut(graph, available, *result.state) ||
                      HasContestedState(result, options))) {
    for (const GlobalStart start : {GlobalStart::kPairs, GlobalStart::kPositions}) {
      ORBWEAVE_RETURN_IF_ERROR(
          CompeteGlobally(problem, graph, available, start, options, log, context, result));
    }
  }
  return result;
}

}  // namespace orbweave
