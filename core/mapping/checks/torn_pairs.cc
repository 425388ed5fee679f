// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/torn_pairs.h"

#include <algorithm>
#include <utility>

#include "core/mapping/checks/find_contradicted_pairs.h"
#include "core/mapping/lengths/street_lines.h"
#include "core/mapping/model/registered_by_drive.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

/// Of all drives together.
double UsualStepIn(const MappingState& state) {
  const auto& images = state.Problem().images;
  const std::vector<ImageSlot> sequence = RegisteredByDrive(state);
  std::vector<double> steps;
  for (size_t i = 1; i < sequence.size(); ++i) {
    if (images[sequence[i - 1]].drive != images[sequence[i]].drive) continue;
    steps.push_back((state.Centre(sequence[i]) - state.Centre(sequence[i - 1])).norm());
  }
  return UsualStep(std::move(steps));
}

bool FollowOneAnother(const ClusterImage& a, const ClusterImage& b) {
  const auto [first, last] = std::minmax({a.rank_in_drive, b.rank_in_drive});
  return a.drive == b.drive && last - first <= kReachAlongLine;
}

}  // namespace

std::vector<ImagePair> FindTornPairs(const MappingState& state, const MappingOptions& options) {
  std::vector<ImagePair> torn = JudgePairs(state, options).askew;
  if (torn.empty()) return torn;
  const double reach = static_cast<double>(kReachAlongLine) * UsualStepIn(state);
  std::erase_if(torn, [&](const ImagePair& pair) {
    const ImageSlot a = SlotOf(state.Problem(), pair.a).value();
    const ImageSlot b = SlotOf(state.Problem(), pair.b).value();
    return (state.Centre(b) - state.Centre(a)).norm() > reach &&
           !FollowOneAnother(state.Problem().images[a], state.Problem().images[b]);
  });
  return torn;
}

}  // namespace orbweave
