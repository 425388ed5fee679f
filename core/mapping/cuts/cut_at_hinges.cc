// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/cut_at_hinges.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/mapping/cuts/hung_piece.h"
#include "core/mapping/cuts/parts_of_one_scale.h"
#include "core/mapping/cuts/parts_that_pairs_hold.h"
#include "core/mapping/positioning/place_on_gnss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Of the way from the joint: pieces that are bent by less, ten degrees, are not elsewhere.
constexpr double kHardlyBent = 0.2;

/// Where GNSS has a piece.
enum class GnssSays { kNothing, kAsItIs, kElsewhere };

/// It is elsewhere where its positions agree with it by itself, but not as the rest has it.
GnssSays AskGnss(const MappingState& state, const HungPiece& piece) {
  const std::vector<ImageSlot> hung =
      ImagesNear(state, state.Centre(piece.end_in_piece), piece.images);
  const std::optional<Sim3> enu_from_world =
      PlaceOnGnss(state, ImagesNear(state, state.Centre(piece.end_in_rest), piece.rest));
  if (!enu_from_world) return GnssSays::kNothing;
  const Vector3d joint = *enu_from_world * state.Centre(piece.end_in_rest);
  size_t asked = 0;
  size_t agreeing = 0;
  for (const ImageSlot image : hung) {
    const PosePrior& prior = state.Problem().images[image].prior;
    if (!prior.position_in_enu) continue;
    const Vector3d error = *enu_from_world * state.Centre(image) - *prior.position_in_enu;
    const Vector3d way = *prior.position_in_enu - joint;
    const double allowed =
        std::max(kMaxFixSigmas * prior.horizontal_sigma_m, kHardlyBent * way.head<2>().norm());
    ++asked;
    agreeing += error.head<2>().norm() <= allowed ? 1U : 0U;
  }
  if (asked == 0) return GnssSays::kNothing;
  if (static_cast<double>(agreeing) >= kMinAgreeingFixes * static_cast<double>(asked))
    return GnssSays::kAsItIs;
  return PlaceOnGnss(state, hung) ? GnssSays::kElsewhere : GnssSays::kNothing;
}

/// The smaller side of a weak joint that GNSS has elsewhere; empty: none is.
std::vector<ImageSlot> FindHungElsewhere(const MappingState& state, const MappingOptions& options) {
  const auto fewest = static_cast<uint32_t>(options.min_inliers);
  const std::vector<Joint> holding = HoldingJoints(state);
  for (size_t i = holding.size(); i-- > 0 && holding[i].telling < fewest;) {
    HungPiece piece = PieceAt(state, holding, i);
    if (CountCommon(state, piece) < fewest && AskGnss(state, piece) == GnssSays::kElsewhere)
      return std::move(piece.images);
  }
  return {};
}

/// Of parts, but for the first, the last one that GNSS does not have as it is; empty: there is
/// none.
std::vector<ImageSlot> FindOddPart(const MappingState& state,
                                   std::vector<std::vector<ImageSlot>> parts) {
  while (parts.size() > 1) {
    const std::optional<HungPiece> piece = PieceOf(state, parts.back());
    if (!piece || AskGnss(state, *piece) != GnssSays::kAsItIs) return std::move(parts.back());
    parts.pop_back();
  }
  return {};
}

/// What is to be cut off next, ascending; empty: nothing.
std::vector<ImageSlot> FindHungPiece(const MappingState& state, const MappingOptions& options) {
  std::vector<ImageSlot> piece = FindOddPart(state, PartsThatPairsHold(state, options));
  if (piece.empty()) piece = FindHungElsewhere(state, options);
  if (piece.empty()) piece = FindOddPart(state, PartsOfOneScale(state, options));
  return piece;
}

MappingState WithoutImages(MappingState state, const std::vector<ImageSlot>& images) {
  for (const ImageSlot image : images) state.Deregister(image);
  return state;
}

}  // namespace

std::vector<MappingState> CutAtHinges(MappingState submodel, const MappingOptions& options) {
  std::vector<MappingState> pieces;
  std::vector<MappingState> uncut;
  uncut.push_back(std::move(submodel));
  while (!uncut.empty()) {
    MappingState whole = std::move(uncut.back());
    uncut.pop_back();
    const std::vector<ImageSlot> piece = FindHungPiece(whole, options);
    if (piece.empty()) {
      pieces.push_back(std::move(whole));
      continue;
    }
    uncut.push_back(WithoutImages(whole, Without(whole.Registered(), piece)));
    uncut.push_back(WithoutImages(std::move(whole), piece));
  }
  std::ranges::stable_sort(pieces, std::greater<>(), [](const MappingState& piece) {
    return piece.Registered().size();
  });
  return pieces;
}

}  // namespace orbweave
