// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstruct_cluster.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "core/bundle/bearing_error.h"
#include "core/mapping/adjustment/adapt_to_parallax.h"
#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/adjustment/weigh_pixels_alike.h"
#include "core/mapping/bridges/join_by_bridges.h"
#include "core/mapping/checks/drop_off_scale_images.h"
#include "core/mapping/checks/find_contradicted_pairs.h"
#include "core/mapping/checks/parted_pairs.h"
#include "core/mapping/cuts/cut_at_hinges.h"
#include "core/mapping/cuts/split_by_gnss.h"
#include "core/mapping/export_submodel.h"
#include "core/mapping/find_small_motions.h"
#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/gnss_ways.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/measure_gap_lengths.h"
#include "core/mapping/lengths/measure_pair_lengths.h"
#include "core/mapping/lengths/tying_rays.h"
#include "core/mapping/mending/mend_uneven.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/reconstruct_submodel.h"

namespace orbweave {
namespace {

constexpr uint32_t kFewestImages = 2;

/// Squared angles of all observations in pixels at the equator of their panoramas.
struct ResidualSum {
  double sum_px2 = 0.0;
  size_t count = 0;

  void Add(const ClusterProblem& problem, const Reconstruction& reconstruction) {
    for (const Track& track : reconstruction.tracks) {
      for (const Observation& seen : track.observations) {
        const ClusterImage& image = problem.images[SlotOf(problem, seen.ref.image).value()];
        const double error_px = image.camera.PixelsFromAngle(
            BearingError(reconstruction.images.at(seen.ref.image).cam_from_world,
                         track.point_in_world,
                         seen.bearing));
        sum_px2 += error_px * error_px;
        ++count;
      }
    }
  }
  [[nodiscard]] double Rms() const {
    return count == 0 ? 0.0 : std::sqrt(sum_px2 / static_cast<double>(count));
  }
};

uint32_t CountAvailable(const std::vector<uint8_t>& available) {
  return static_cast<uint32_t>(std::count(available.begin(), available.end(), 1));
}

std::string ReasonOf(const CorrespondenceGraph& graph,
                     ImageSlot image,
                     const RegistrationLog& log,
                     const MappingOptions& options) {
  if (graph.pairs_of_image[image].empty()) return "no verified matches";
  return ReasonOf(log[image], static_cast<uint32_t>(ScheduleOf(options).min_visible));
}

void SortLargestFirst(std::vector<Reconstruction>& submodels) {
  std::stable_sort(
      submodels.begin(), submodels.end(), [](const Reconstruction& x, const Reconstruction& y) {
        return x.images.size() > y.images.size();
      });
}

/// Cuts off what hangs by too little (CutAtHinges); pieces are adjusted without the points that
/// held them together.
absl::StatusOr<std::vector<MappingState>> CutAll(std::vector<MappingState> states,
                                                 const MappingOptions& options,
                                                 const StageContext& context,
                                                 RegistrationLog& log) {
  std::vector<MappingState> cut;
  for (MappingState& state : states) {
    std::vector<MappingState> pieces = CutAtHinges(std::move(state), options);
    for (MappingState& piece : pieces) {
      const bool is_model =
          piece.Registered().size() >= static_cast<size_t>(options.min_component_images);
      if (pieces.size() > 1 && !is_model) {
        for (const ImageSlot image : piece.Registered()) log[image].loss = RegistrationLoss::kCut;
      }
      if (pieces.size() > 1 && piece.Registered().size() >= kFewestImages)
        ORBWEAVE_RETURN_IF_ERROR(AdjustFinalModel(piece, options, context));
      cut.push_back(std::move(piece));
    }
  }
  return cut;
}

/// Without images on a scale of their own, which may be a submodel by themselves.
absl::Status DropOffScale(MappingState& state,
                          const MappingOptions& options,
                          const StageContext& context,
                          RegistrationLog& log) {
  for (auto off = DropOffScaleImages(state); !off.empty(); off = DropOffScaleImages(state)) {
    for (const ImageSlot image : off) log[image].loss = RegistrationLoss::kScale;
    ORBWEAVE_RETURN_IF_ERROR(AdjustFinalModel(state, options, context));
  }
  return absl::OkStatus();
}

/// Grows submodels until no images are left, cuts off what hangs by too little, then joins those
/// that bridges hold together, and cuts these once more.
absl::StatusOr<std::vector<MappingState>> MapSubmodels(const ClusterProblem& problem,
                                                       const CorrespondenceGraph& graph,
                                                       const MappingOptions& options,
                                                       const StageContext& context,
                                                       RegistrationLog& log,
                                                       ClusterReconstruction& result) {
  std::vector<uint8_t> available(problem.images.size(), 1);
  std::vector<MappingState> states;
  size_t largest = 0;
  while (CountAvailable(available) >= kFewestImages) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        SubmodelResult submodel,
        ReconstructSubmodel(problem, graph, available, options, log, context));
    result.num_global_adjustments += submodel.growth.num_global_adjustments;
    result.num_local_adjustments += submodel.growth.num_local_adjustments;
    if (states.empty()) result.start_remark = submodel.start_remark;
    if (!submodel.state || submodel.state->Registered().empty()) break;
    const std::vector<ImageSlot>& registered = submodel.state->Registered();
    if (ScheduleOf(options).relaxes_registration) {
      ORBWEAVE_RETURN_IF_ERROR(DropOffScale(*submodel.state, options, context, log));
      ORBWEAVE_RETURN_IF_ERROR(MendUneven(*submodel.state, options, context).status());
    }
    for (const ImageSlot image : registered) available[image] = 0;
    if (registered.size() > largest) {
      largest = registered.size();
      result.started_globally = submodel.started_globally;
      result.start_remark = submodel.start_remark;
    }
    states.push_back(*std::move(submodel.state));
  }
  if (!ScheduleOf(options).relaxes_registration) return states;
  ORBWEAVE_ASSIGN_OR_RETURN(states, CutAll(std::move(states), options, context, log));
  const size_t grown = states.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      states, JoinByBridges(std::move(states), problem, graph, options, log, context));
  result.num_joined = static_cast<int>(grown - std::min(grown, states.size()));
  if (result.num_joined > 0) {
    ORBWEAVE_ASSIGN_OR_RETURN(states, CutAll(std::move(states), options, context, log));
  }
  for (MappingState& state : states)
    ORBWEAVE_RETURN_IF_ERROR(DropOffScale(state, options, context, log));
  return states;
}

bool HoldAModel(const std::vector<MappingState>& states, const MappingOptions& options) {
  return std::ranges::any_of(states, [&](const MappingState& state) {
    return state.Registered().size() >= static_cast<size_t>(options.min_component_images);
  });
}

/// The state as a value; of our own preset in the pieces that GNSS leaves of it.
std::vector<Reconstruction> PiecesOf(const MappingState& state, const MappingOptions& options) {
  if (ScheduleOf(options).tightens) return SplitByGnss(state.Problem(), ExportSubmodel(state));
  std::vector<Reconstruction> whole;
  whole.push_back(ExportSubmodel(state));
  return whole;
}

/// What pairs and rays say of the model.
void MeasureSubmodel(const MappingState& state,
                     const MappingOptions& options,
                     ClusterReconstruction& result) {
  const JudgedPairs judged = JudgePairs(state, options);
  result.contradicted_pairs.insert(
      result.contradicted_pairs.end(), judged.contradicted.begin(), judged.contradicted.end());
  result.explained_pairs.insert(
      result.explained_pairs.end(), judged.explained.begin(), judged.explained.end());
  const AskedRays asked(state, options);
  std::ranges::copy(MeasurePairLengths(asked), std::back_inserter(result.pair_lengths));
  const GnssWays gnss(state, kMatchTolerance * options.max_error_px);
  std::vector<GapLength> gaps = MeasureGapLengths(asked, &gnss);
  AddTyingRays(asked, gaps);
  std::ranges::move(gaps, std::back_inserter(result.gap_lengths));
}

/// In pieces (PiecesOf). `reasons`: per image, of those that are none.
void TakePieces(const MappingState& state,
                const MappingOptions& options,
                ResidualSum& residuals,
                std::vector<std::string>& reasons,
                ClusterReconstruction& result) {
  for (Reconstruction& piece : PiecesOf(state, options)) {
    if (piece.images.size() < static_cast<size_t>(options.min_component_images)) {
      for (const auto& [id, image] : piece.images) {
        reasons[SlotOf(state.Problem(), id).value()] =
            "points put it more than twice as far from its neighbours as its GNSS position "
            "does";
      }
      continue;
    }
    residuals.Add(state.Problem(), piece);
    result.submodels.push_back(std::move(piece));
  }
}

/// Walls that are not there go at the very end: where images stand in the wrong place they are what
/// tells of it.
absl::Status TakeSubmodel(MappingState& state,
                          const MappingOptions& options,
                          const StageContext& context,
                          ResidualSum& residuals,
                          std::vector<std::string>& reasons,
                          ClusterReconstruction& result) {
  MeasureSubmodel(state, options, result);
  if (ScheduleOf(options).tightens)
    ORBWEAVE_RETURN_IF_ERROR(AdjustWithoutGhosts(state, options, context));
  TakePieces(state, options, residuals, reasons, result);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<ClusterReconstruction> ReconstructCluster(const ClusterProblem& problem,
                                                         const MappingOptions& stated,
                                                         const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  if (ScheduleOf(stated).weighs_pixels_alike) {
    if (const auto alike = WeighPixelsAlike(problem))
      return ReconstructCluster(*alike, stated, context);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const CorrespondenceGraph graph, BuildCorrespondenceGraph(problem));
  const MappingOptions options =
      ScheduleOf(stated).tightens ? AdaptToParallax(problem, graph, stated) : stated;
  RegistrationLog log(problem.images.size());
  ClusterReconstruction result;
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<MappingState> states,
                            MapSubmodels(problem, graph, options, context, log, result));
  if (ScheduleOf(stated).tightens && !HoldAModel(states, options)) {
    if (const auto told = FindSmallMotions(problem))
      return ReconstructCluster(*told, stated, context);
  }
  ResidualSum residuals;
  std::vector<std::string> reasons(problem.images.size());
  for (MappingState& state : states) {
    const size_t size = state.Registered().size();
    if (size >= static_cast<size_t>(options.min_component_images)) {
      ORBWEAVE_RETURN_IF_ERROR(TakeSubmodel(state, options, context, residuals, reasons, result));
      continue;
    }
    for (const ImageSlot image : state.Registered()) {
      if (log[image].loss == RegistrationLoss::kCut) continue;
      reasons[image] = "its component of " + std::to_string(size) + " images is smaller than " +
                       std::to_string(options.min_component_images);
    }
  }

  SortLargestFirst(result.submodels);
  result.parted_pairs = PartedPairs(problem, result.submodels);
  result.residual_rms_px = residuals.Rms();
  for (ImageSlot image = 0; image < problem.images.size(); ++image) {
    const ImageId id = problem.images[image].id;
    const bool registered = std::ranges::any_of(
        result.submodels, [&](const Reconstruction& each) { return each.images.contains(id); });
    if (registered) continue;
    if (reasons[image].empty()) reasons[image] = ReasonOf(graph, image, log, options);
    result.not_registered.push_back({id, reasons[image]});
  }
  return result;
}

}  // namespace orbweave
