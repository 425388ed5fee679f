// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/moves_along.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/base/quantile.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr double kStandingShare = 0.3;
constexpr double kJump = 3.0;  // times either step beside it, as a gap (LeftOffBehind) at least is
// Between most steps of a carrier that moves; what trembles turns back.
constexpr double kMinOnwardCos = 0.5;

/// The steps between places, and which of them are gaps.
class Steps {
 public:
  explicit Steps(std::span<const Eigen::Vector3d> places) {
    for (size_t i = 1; i < places.size(); ++i) {
      steps_.emplace_back(places[i] - places[i - 1]);
      lengths_.push_back(steps_.back().norm());
    }
    FindJumps();
    if (!LeadOn()) std::ranges::fill(is_gap_, uint8_t{0});
  }

  [[nodiscard]] bool IsGap(size_t step) const { return is_gap_[step] != 0; }
  [[nodiscard]] size_t Count() const { return lengths_.size(); }
  [[nodiscard]] double Usual() const {
    std::vector<double> lengths;
    for (size_t i = 0; i < lengths_.size(); ++i) {
      if (!IsGap(i)) lengths.push_back(lengths_[i]);
    }
    return UsualStep(std::move(lengths));
  }

 private:
  void FindJumps() {
    for (size_t i = 0; i < lengths_.size(); ++i) {
      const double before = i > 0 ? lengths_[i - 1] : 0.0;
      const double behind = i + 1 < lengths_.size() ? lengths_[i + 1] : 0.0;
      is_gap_.push_back(lengths_[i] > kJump * std::max(before, behind) ? 1 : 0);
    }
  }

  /// Whether steps that follow each other, but for jumps, mostly lead on. Of a camera that is
  /// carried from stand to stand they do not, and the jumps are its way.
  [[nodiscard]] bool LeadOn() const {
    std::vector<double> cosines;
    for (size_t i = 1; i < steps_.size(); ++i) {
      if (IsGap(i - 1) || IsGap(i) || lengths_[i - 1] * lengths_[i] == 0.0) continue;
      cosines.push_back(steps_[i - 1].dot(steps_[i]) / (lengths_[i - 1] * lengths_[i]));
    }
    return !cosines.empty() && Quantile(std::move(cosines), 0.5) > kMinOnwardCos;
  }

  std::vector<Eigen::Vector3d> steps_{};
  std::vector<double> lengths_{};
  std::vector<uint8_t> is_gap_{};
};

}  // namespace

std::vector<MoveAlong> MovesAlong(std::span<const Eigen::Vector3d> places) {
  std::vector<MoveAlong> moves(places.size());
  if (places.size() < 2) return moves;
  const Steps steps(places);
  const double least = kStandingShare * steps.Usual();
  for (size_t i = 0; i < places.size(); ++i) {
    MoveAlong& move = moves[i];
    move.first = i > 0 && !steps.IsGap(i - 1) ? i - 1 : i;
    move.last = i < steps.Count() && !steps.IsGap(i) ? i + 1 : i;
    const Eigen::Vector3d moved = places[move.last] - places[move.first];
    if (moved.norm() > static_cast<double>(move.last - move.first) * least) move.moved = moved;
  }
  return moves;
}

}  // namespace orbweave
