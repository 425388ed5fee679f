// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/hung_piece.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "core/graph/disjoint_sets.h"
#include "core/scene/reconstruction.h"

namespace orbweave {
namespace {

/// Points that more images see hold together those that are next to each other among them.
constexpr size_t kAllPairs = 12;

/// All joints, those of most telling points first, then of most points, then in order of their
/// images.
std::vector<Joint> JointsOf(const MappingState& state) {
  // The other image of two that see a point, and whether that tells, by the first.
  std::vector<std::vector<std::pair<ImageSlot, bool>>> seen_by_both(state.Graph().NumImages());
  for (PointIndex p = 0; p < state.EndOfPoints(); ++p) {
    const std::vector<ImageSlot> images = ImagesThatSee(state, p);
    const size_t reach = images.size() <= kAllPairs ? images.size() : 1;
    for (size_t i = 0; i < images.size(); ++i) {
      for (size_t j = i + 1; j < std::min(images.size(), i + 1 + reach); ++j)
        seen_by_both[images[i]].emplace_back(images[j], images.size() >= kImagesThatTellSize);
    }
  }
  std::vector<Joint> joints;
  for (ImageSlot a = 0; a < seen_by_both.size(); ++a) {
    std::ranges::sort(seen_by_both[a]);
    for (const auto& [b, is_telling] : seen_by_both[a]) {
      if (joints.empty() || joints.back().a != a || joints.back().b != b) joints.push_back({a, b});
      ++joints.back().points;
      joints.back().telling += is_telling ? 1U : 0U;
    }
  }
  std::ranges::stable_sort(joints, std::greater<>(), [](const Joint& joint) {
    return std::pair(joint.telling, joint.points);
  });
  return joints;
}

}  // namespace

std::vector<Joint> HoldingJoints(const MappingState& state) {
  DisjointSets held(state.Graph().NumImages());
  std::vector<Joint> holding;
  std::ranges::copy_if(JointsOf(state), std::back_inserter(holding), [&](const Joint& joint) {
    return held.Unite(joint.a, joint.b);
  });
  return holding;
}

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

std::optional<HungPiece> PieceOf(const MappingState& state, const std::vector<ImageSlot>& images) {
  const auto is_inside = [&](ImageSlot image) { return std::ranges::binary_search(images, image); };
  for (const Joint& joint : JointsOf(state)) {
    if (is_inside(joint.a) == is_inside(joint.b)) continue;
    const auto [outside, inside] =
        is_inside(joint.a) ? std::pair(joint.b, joint.a) : std::pair(joint.a, joint.b);
    return HungPiece{images, Without(state.Registered(), images), outside, inside};
  }
  return std::nullopt;
}

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

std::vector<ImageSlot> Without(std::vector<ImageSlot> images,
                               const std::vector<ImageSlot>& others) {
  std::ranges::sort(images);
  std::erase_if(images, [&](ImageSlot image) { return std::ranges::binary_search(others, image); });
  return images;
}

}  // namespace orbweave
