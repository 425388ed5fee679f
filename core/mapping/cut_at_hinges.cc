// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cut_at_hinges.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "core/graph/disjoint_sets.h"
#include "core/mapping/parts_of_one_scale.h"
#include "core/mapping/parts_that_pairs_hold.h"
#include "core/mapping/place_on_gnss.h"
#include "core/scene/reconstruction.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// Points that more images see hold together those that are next to each other among them.
constexpr size_t kAllPairs = 12;
/// Of the way from the joint: pieces that are bent by less, ten degrees, are not elsewhere.
constexpr double kHardlyBent = 0.2;

/// Two registered images and the points that both see.
struct Joint {
  ImageSlot a = 0;
  ImageSlot b = 0;
  uint32_t telling = 0;  ///< that a third image sees as well
  uint32_t points = 0;   ///< all
};

/// All joints, those of most telling points first, then of most points, then in order of their
/// images.
std::vector<Joint> JointsOf(const MappingState& state) {
  std::vector<std::tuple<ImageSlot, ImageSlot, bool>> seen_by_both;
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p) {
    const std::vector<ImageSlot> images = ImagesThatSee(state, p);
    const size_t reach = images.size() <= kAllPairs ? images.size() : 1;
    for (size_t i = 0; i < images.size(); ++i) {
      for (size_t j = i + 1; j < std::min(images.size(), i + 1 + reach); ++j)
        seen_by_both.emplace_back(images[i], images[j], images.size() >= kImagesThatTellSize);
    }
  }
  std::ranges::sort(seen_by_both);
  std::vector<Joint> joints;
  for (const auto& [a, b, is_telling] : seen_by_both) {
    if (joints.empty() || joints.back().a != a || joints.back().b != b) joints.push_back({a, b});
    ++joints.back().points;
    joints.back().telling += is_telling ? 1U : 0U;
  }
  std::ranges::stable_sort(joints, std::greater<>(), [](const Joint& joint) {
    return std::pair(joint.telling, joint.points);
  });
  return joints;
}

/// The joints that hold a submodel together, in the order of JointsOf.
std::vector<Joint> HoldingJoints(const MappingState& state) {
  DisjointSets held(state.Graph().NumImages());
  std::vector<Joint> holding;
  std::ranges::copy_if(JointsOf(state), std::back_inserter(holding), [&](const Joint& joint) {
    return held.Unite(joint.a, joint.b);
  });
  return holding;
}

/// Some of the images, which hang at the rest, and the two at the ends of the joint.
struct HungPiece {
  std::vector<ImageSlot> images{};  ///< ascending
  std::vector<ImageSlot> rest{};    ///< ascending
  ImageSlot end_in_rest = 0;
  ImageSlot end_in_piece = 0;
};

/// The smaller side of one of the holding joints.
HungPiece PieceAt(const MappingState& state, const std::vector<Joint>& holding, size_t cut) {
  DisjointSets held(state.Graph().NumImages());
  for (size_t i = 0; i < holding.size(); ++i) {
    if (i != cut) held.Unite(holding[i].a, holding[i].b);
  }
  const Joint& joint = holding[cut];
  std::vector<ImageSlot> with_a;
  std::vector<ImageSlot> others;
  for (const ImageSlot image : state.Registered())
    (held.Find(image) == held.Find(joint.a) ? with_a : others).push_back(image);
  std::ranges::sort(with_a);
  std::ranges::sort(others);
  if (with_a.size() <= others.size())
    return {std::move(with_a), std::move(others), joint.b, joint.a};
  return {std::move(others), std::move(with_a), joint.a, joint.b};
}

/// Those that are not among others; ascending; `others` come so.
std::vector<ImageSlot> Without(std::vector<ImageSlot> images,
                               const std::vector<ImageSlot>& others) {
  std::ranges::sort(images);
  std::erase_if(images, [&](ImageSlot image) { return std::ranges::binary_search(others, image); });
  return images;
}

/// These images, by the joint of most points with the rest; nullopt where there is none.
std::optional<HungPiece> PieceOf(const MappingState& state, std::vector<ImageSlot> images) {
  const auto is_inside = [&](ImageSlot image) { return std::ranges::binary_search(images, image); };
  for (const Joint& joint : JointsOf(state)) {
    if (is_inside(joint.a) == is_inside(joint.b)) continue;
    const auto [outside, inside] =
        is_inside(joint.a) ? std::pair(joint.b, joint.a) : std::pair(joint.a, joint.b);
    return HungPiece{images, Without(state.Registered(), images), outside, inside};
  }
  return std::nullopt;
}

/// Telling points that both sides see.
uint32_t CountCommon(const MappingState& state, const HungPiece& piece) {
  uint32_t common = 0;
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p) {
    const std::vector<ImageSlot> images = ImagesThatSee(state, p);
    if (images.size() < kImagesThatTellSize) continue;
    const auto inside = std::ranges::count_if(
        images, [&](ImageSlot image) { return std::ranges::binary_search(piece.images, image); });
    common += inside > 0 && static_cast<size_t>(inside) < images.size() ? 1U : 0U;
  }
  return common;
}

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

/// A part of a scale of its own that GNSS does not have as it is; empty: none is.
std::vector<ImageSlot> FindUntoldPart(const MappingState& state, const MappingOptions& options) {
  std::vector<std::vector<ImageSlot>> parts = PartsOfOneScale(state, options);
  while (parts.size() > 1) {
    const std::optional<HungPiece> piece = PieceOf(state, parts.back());
    if (!piece || AskGnss(state, *piece) != GnssSays::kAsItIs) return std::move(parts.back());
    parts.pop_back();
  }
  return {};
}

/// What is to be cut off next, ascending; empty: nothing.
std::vector<ImageSlot> FindHungPiece(const MappingState& state, const MappingOptions& options) {
  std::vector<std::vector<ImageSlot>> parts = PartsThatPairsHold(state, options);
  if (parts.size() > 1) return std::move(parts.back());
  std::vector<ImageSlot> elsewhere = FindHungElsewhere(state, options);
  return elsewhere.empty() ? FindUntoldPart(state, options) : elsewhere;
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
