// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/find_gap_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/mapping/lengths/find_length_faults.h"
#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/told_lengths.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

// Rivals make the way a tenth to three times as long, and by a quarter of it another: what is
// nearer agrees with the model's length in part (kCloseTolerance, of pairs three times as long).
constexpr double kRivalShare = 0.25;
constexpr double kFarthestBack = -0.9;
constexpr double kFarthest = 2.0;
// Those of ways that were a quarter and more off reached two (MeasureGapLengths).
constexpr double kClearDeviations = 3.0;

/// A pair that leads across: the step as the model has it, and what is told of it.
struct Crossing {
  Vector3d step = Vector3d::Zero();
  ToldLengths told;
};

/// The larger s with |step + s way| = length.
std::optional<double> ShiftTo(double length, const Vector3d& step, const Vector3d& way) {
  const double along = step.dot(way);
  const double discriminant = along * along - step.squaredNorm() + length * length;
  if (discriminant < 0.0) return std::nullopt;
  return std::sqrt(discriminant) - along;
}

class Crossings {
 public:
  Crossings(const AskedRays& asked, const GapVotes& gap, std::span<const LengthVote> votes)
      : state_(asked.state) {
    const Vector3d way = state_.Centre(gap.next) - state_.Centre(gap.image);
    length_ = way.norm();
    way_ = way.normalized();
    std::map<uint32_t, std::vector<double>> lengths;
    for (const LengthVote& vote : votes) lengths[vote.pair].push_back(vote.log_length);
    for (auto& [pair, log_lengths] : lengths) {
      if (log_lengths.size() < kFewestRaysOfPair) continue;
      Add(state_.Graph().pairs[asked.pairs[pair]], std::move(log_lengths));
    }
  }

  [[nodiscard]] double CountAgreeing(double shift) const {
    double count = 0.0;
    for (const Crossing& crossing : crossings_)
      count += crossing.told.CountAgreeing(crossing.step + shift * way_);
    return count;
  }

  /// Those that leave what lies behind the way behind it: where houses repeat, longer pairs may say
  /// that it leads backwards, but a pair that does contradicts the model by itself.
  [[nodiscard]] std::vector<double> Candidates() const {
    std::vector<double> shifts;
    for (const Crossing& crossing : crossings_) {
      for (const double length : crossing.told.Modes()) {
        const auto shift = ShiftTo(length, crossing.step, way_);
        if (shift && *shift > -length_) shifts.push_back(*shift);
      }
    }
    return shifts;
  }

  /// Of each crossing one, where its votes crowd between two shifts.
  [[nodiscard]] std::vector<double> CandidatesWithin(double low, double high) const {
    std::vector<double> shifts;
    for (const Crossing& crossing : crossings_) {
      const double shortest = (crossing.step + low * way_).norm();
      const double longest = (crossing.step + high * way_).norm();
      const std::optional<double> length = crossing.told.ModeWithin(shortest, longest);
      const auto shift = length ? ShiftTo(*length, crossing.step, way_) : std::nullopt;
      if (shift) shifts.push_back(*shift);
    }
    return shifts;
  }

  /// The median of those shifts that agree with it.
  [[nodiscard]] double Refined(double shift) const {
    std::vector<double> shifts;
    for (const Crossing& crossing : crossings_) {
      const double length = (crossing.step + shift * way_).norm();
      for (const double near : crossing.told.Near(length)) {
        if (const auto exact = ShiftTo(near, crossing.step, way_)) shifts.push_back(*exact);
      }
    }
    return shifts.empty() ? shift : Quantile(std::move(shifts), 0.5);
  }

  /// So many or fewer agree with any shift between two.
  [[nodiscard]] double MostWithin(double low, double high) const {
    double most = 0.0;
    for (const Crossing& crossing : crossings_) {
      const auto length = [&](double shift) { return (crossing.step + shift * way_).norm(); };
      const double nearest = std::clamp(-crossing.step.dot(way_), low, high);
      most += crossing.told.MostWithin(length(nearest), std::max(length(low), length(high)));
    }
    return most;
  }

  /// The shift between two with which most agree; elsewhere is 0 where votes of none crowd there.
  [[nodiscard]] GapShift BestWithin(double low, double high) const {
    GapShift best{.here = CountAgreeing(0.0)};
    for (const double candidate : CandidatesWithin(low, high)) {
      const double shift = std::clamp(Refined(candidate), low, high);
      const double agreeing = CountAgreeing(shift);
      if (agreeing <= best.elsewhere) continue;
      best.elsewhere = agreeing;
      best.shift = shift;
    }
    return best;
  }

  /// Those with the best rival; more where that many leave no doubt (GapShift::IsHere).
  [[nodiscard]] double CountRivals(double here) const {
    const std::array<std::pair<double, double>, 2> ranges = {
        {{kFarthestBack * length_, -kRivalShare * length_},
         {kRivalShare * length_, kFarthest * length_}}};
    double most = 0.0;
    for (const auto& [low, high] : ranges) most = std::max(most, MostWithin(low, high));
    if (GapShift{.here = here, .rival = most}.IsHere()) return most;
    double rivals = 0.0;
    for (const auto& [low, high] : ranges)
      rivals = std::max(rivals, BestWithin(low, high).elsewhere);
    return rivals;
  }

 private:
  void Add(const LinkedPair& pair, std::vector<double> log_lengths) {
    const Rigid3& b_from_a = state_.Problem().pairs[pair.index].b_from_a;
    Vector3d step = state_.Centre(pair.b) - state_.Centre(pair.a);
    Vector3d direction =
        state_.CamFromWorld(pair.a).rotation.conjugate() * b_from_a.Centre().normalized();
    if (step.dot(way_) < 0.0) {
      step = -step;
      direction = -direction;
    }
    crossings_.push_back({step, ToldLengths(direction, std::move(log_lengths))});
  }

  const MappingState& state_;
  Vector3d way_ = Vector3d::Zero();  ///< unit
  double length_ = 0.0;
  std::vector<Crossing> crossings_{};
};

}  // namespace

bool GapShift::IsClear() const { return IsToldElsewhere(here, elsewhere); }

bool GapShift::IsHere() const { return DeviationsElsewhere(rival, here) > kClearDeviations; }

bool TellEnough(std::span<const LengthVote> votes) {
  std::map<uint32_t, size_t> votes_of_pair;
  for (const LengthVote& vote : votes) ++votes_of_pair[vote.pair];
  size_t rays = 0;
  uint32_t pairs = 0;
  for (const auto& [pair, count] : votes_of_pair) {
    if (count < kFewestRaysOfPair) continue;
    rays += count;
    ++pairs;
  }
  return TellsEnough({.told = static_cast<double>(rays)}, pairs);
}

GapShift FindGapShift(const AskedRays& asked,
                      const GapVotes& gap,
                      std::span<const LengthVote> votes) {
  if (!TellEnough(votes)) return {};
  const Crossings crossings(asked, gap, votes);
  GapShift best{.here = crossings.CountAgreeing(0.0)};
  best.elsewhere = best.here;
  best.rival = crossings.CountRivals(best.here);
  for (const double candidate : crossings.Candidates()) {
    for (const double shift : {candidate, crossings.Refined(candidate)}) {
      const double agreeing = crossings.CountAgreeing(shift);
      if (agreeing <= best.elsewhere) continue;
      best.elsewhere = agreeing;
      best.shift = shift;
    }
  }
  return best;
}

GapShift FindGapShiftWithin(const AskedRays& asked,
                            const GapVotes& gap,
                            std::span<const LengthVote> votes,
                            double low,
                            double high,
                            double min_deviations) {
  const Crossings crossings(asked, gap, votes);
  const double here = crossings.CountAgreeing(0.0);
  if (DeviationsElsewhere(here, crossings.MostWithin(low, high)) <= min_deviations)
    return {.here = here};
  return crossings.BestWithin(low, high);
}

}  // namespace orbweave
