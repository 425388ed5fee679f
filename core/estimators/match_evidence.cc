// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/match_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/estimators/pair_kernels.h"
#include "core/geometry/place_pairs.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kRotationSample = 2;
using internal::kNumErrors;
/// Exchanged matches at most: the share of chance is then known to a tenth where it is a hundredth.
constexpr size_t kMaxExchanges = 16384;

/// The matches that speak for themselves.
std::vector<PlacePairs::Match> IndependentMatches(const BearingPairs& pairs) {
  PlacePairs places;
  for (size_t i = 0; i < pairs.Size(); ++i) places.Add(pairs.A(i), pairs.B(i));
  return places.Counted();
}

/// Counts how many matches, or exchanged ones, a pose explains.
class PoseTest {
 public:
  PoseTest(const std::vector<PlacePairs::Match>& matches,
           const Rigid3& b_from_a,
           double max_error_rad,
           size_t sample)
      : has_baseline_(!b_from_a.translation.isZero()),
        sample_(has_baseline_ ? sample : kRotationSample),
        size_(matches.size()) {
    for (size_t e = 0; e < kNumErrors; ++e) {
      errors_rad_[e] = max_error_rad / std::exp2(e);
      const double sine = std::sin(errors_rad_[e]);
      limits_.squared[e] = has_baseline_ ? sine * sine : 2.0 - 2.0 * std::cos(errors_rad_[e]);
    }
    limits_.min_cos_far = std::cos(2.0 * max_error_rad);
    for (const PlacePairs::Match& match : matches) AddTurned(b_from_a, match.a);
    for (int round = 0; round < 2; ++round) {
      for (const PlacePairs::Match& match : matches) AddTarget(b_from_a, match.b);
    }
  }

  [[nodiscard]] double Error(size_t e) const { return errors_rad_[e]; }
  [[nodiscard]] size_t Sample() const { return sample_; }

  /// The i-th match of one panorama with the (i + shift)-th of the other, shift below their number.
  [[nodiscard]] internal::ErrorCounts Count(size_t shift) const {
    internal::TurnedColumns a{.along_q = along_q_.data()};
    internal::TargetColumns b{.along_b = along_b_.data() + shift};
    for (size_t k = 0; k < 3; ++k) {
      a.q[k] = q_[k].data();
      a.m[k] = m_[k].data();
      b.b[k] = b_[k].data() + shift;
    }
    return has_baseline_ ? internal::CountWithinPlanes(a, b, size_, limits_)
                         : internal::CountWithinAngles(a, b, size_, limits_);
  }

 private:
  using Columns = std::array<std::vector<double>, 3>;

  static void Add(const Vector3d& bearing, Columns& columns) {
    for (int k = 0; k < 3; ++k) columns[static_cast<size_t>(k)].push_back(bearing[k]);
  }

  void AddTurned(const Rigid3& b_from_a, const Vector3d& bearing) {
    const Vector3d q = b_from_a.rotation * bearing;
    Add(q, q_);
    Add(b_from_a.translation.cross(q), m_);
    along_q_.push_back(b_from_a.translation.dot(q));
  }

  void AddTarget(const Rigid3& b_from_a, const Vector3d& bearing) {
    Add(bearing, b_);
    along_b_.push_back(b_from_a.translation.dot(bearing));
  }

  bool has_baseline_;
  size_t sample_;
  size_t size_;
  std::array<double, kNumErrors> errors_rad_{};
  internal::ErrorLimits limits_{};
  Columns q_{};
  Columns m_{};
  std::vector<double> along_q_{};
  Columns b_{};  ///< twice, one after the other
  std::vector<double> along_b_{};
};

/// Exchanged matches. A match whose place in b is the right one's is no wrong match.
struct Exchanged {
  internal::ErrorCounts within{};
  size_t all = 0;
};

Exchanged CountExchanged(size_t n, const PoseTest& test) {
  const size_t num_shifts = std::min(n - 1, std::max<size_t>(1, kMaxExchanges / n));
  Exchanged counts{.all = num_shifts * n};
  for (size_t shift = 1; shift <= num_shifts; ++shift) {
    const internal::ErrorCounts some = test.Count(shift);
    for (size_t e = 0; e < kNumErrors; ++e) counts.within[e] += some[e];
  }
  return counts;
}

}  // namespace

MatchEvidence EvidenceOf(const BearingPairs& pairs,
                         const Rigid3& b_from_a,
                         double max_error_rad,
                         size_t sample) {
  const std::vector<PlacePairs::Match> matches = IndependentMatches(pairs);
  MatchEvidence evidence{.max_error_rad = max_error_rad,
                         .num_matches = static_cast<uint32_t>(matches.size())};
  const PoseTest test(matches, b_from_a, max_error_rad, sample);
  if (matches.size() <= test.Sample()) return evidence;
  const internal::ErrorCounts found = test.Count(0);
  const Exchanged exchanged = CountExchanged(matches.size(), test);
  for (size_t e = 0; e < kNumErrors; ++e) {
    // One more than was seen: what was not seen may still happen.
    const double chance =
        static_cast<double>(exchanged.within[e] + 1) / static_cast<double>(exchanged.all + 1);
    const double log10_nfa =
        Log10FalseAlarms(matches.size(), found[e], test.Sample(), chance, kNumErrors);
    if (e > 0 && log10_nfa >= evidence.log10_false_alarms) continue;
    evidence.log10_false_alarms = log10_nfa;
    evidence.max_error_rad = test.Error(e);
    evidence.num_inliers = static_cast<uint32_t>(found[e]);
    evidence.chance_share = chance;
  }
  return evidence;
}

double SmallestTellingShare(size_t num_matches,
                            double max_error_rad,
                            double max_log10_false_alarms,
                            size_t sample) {
  const double chance = 0.5 * std::sin(max_error_rad / std::exp2(kNumErrors - 1));
  for (size_t k = sample + 1; k < num_matches; ++k) {
    if (Log10FalseAlarms(num_matches, k, sample, chance, kNumErrors) <= max_log10_false_alarms) {
      return static_cast<double>(k) / static_cast<double>(num_matches);
    }
  }
  return 1.0;
}

}  // namespace orbweave
