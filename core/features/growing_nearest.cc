// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/growing_nearest.h"

#include <algorithm>
#include <span>

#include "core/features/find_nearest_two.h"

namespace orbweave {
namespace {

/// Takes in what was found in another part of the other side, which begins at `first`.
void TakeIn(const std::vector<NearestTwo>& found, size_t first, std::span<NearestTwo> into) {
  for (size_t i = 0; i < found.size(); ++i) {
    NearestTwo shifted = found[i];
    shifted.index += static_cast<uint32_t>(first);
    into[i] = MergeNearest(into[i], shifted);
  }
}

std::vector<NearestTwo> ByIndex(const std::vector<NearestTwo>& by_scale,
                                const std::vector<FeatureIndex>& own,
                                const std::vector<FeatureIndex>& others) {
  std::vector<NearestTwo> by_index(by_scale.size());
  for (size_t i = 0; i < by_scale.size(); ++i) {
    if (by_scale[i].best == kNoDistance) continue;
    by_index[own[i]] = by_scale[i];
    by_index[own[i]].index = others[by_scale[i].index];
  }
  return by_index;
}

}  // namespace

GrowingNearest::GrowingNearest(const PairSide& a, const PairSide& b)
    : a_(a),
      b_(b),
      nearest_{.of_a = std::vector<NearestTwo>(a.num_plain),
               .of_b = std::vector<NearestTwo>(b.num_plain)} {}

void GrowingNearest::GrowTo(size_t count) {
  const size_t end_a = std::max(num_a_, std::min(count, nearest_.of_a.size()));
  const size_t end_b = std::max(num_b_, std::min(count, nearest_.of_b.size()));
  Compare({0, num_a_}, {num_b_, end_b});
  Compare({num_a_, end_a}, {0, end_b});
  num_a_ = end_a;
  num_b_ = end_b;
}

bool GrowingNearest::HasAll() const {
  return num_a_ == nearest_.of_a.size() && num_b_ == nearest_.of_b.size();
}

NearestTwoBothWays GrowingNearest::Nearest() const {
  return {.of_a = ByIndex(nearest_.of_a, a_.by_scale, b_.by_scale),
          .of_b = ByIndex(nearest_.of_b, b_.by_scale, a_.by_scale)};
}

void GrowingNearest::Compare(Range of_a, Range of_b) {
  const auto part = [](const std::vector<uint8_t>& descriptors, Range range) {
    return std::span(descriptors)
        .subspan(range.begin * kDescriptorSize, (range.end - range.begin) * kDescriptorSize);
  };
  const size_t num_a = of_a.end - of_a.begin;
  const size_t num_b = of_b.end - of_b.begin;
  if (num_a == 0 || num_b == 0) return;
  const NearestTwoBothWays found =
      FindNearestTwo(part(a_.descriptors_by_scale, of_a), part(b_.descriptors_by_scale, of_b));
  TakeIn(found.of_a, of_b.begin, std::span(nearest_.of_a).subspan(of_a.begin, num_a));
  TakeIn(found.of_b, of_a.begin, std::span(nearest_.of_b).subspan(of_b.begin, num_b));
}

}  // namespace orbweave
