// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/match_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/epipolar.h"
#include "core/geometry/place_pairs.h"
#include "core/geometry/rotation.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kPoseSample = 5;
constexpr size_t kRotationSample = 2;
constexpr size_t kNumErrors = 4;
/// Exchanged matches at most: the share of chance is then known to a tenth where it is a hundredth.
constexpr size_t kMaxExchanges = 16384;

/// The matches that speak for themselves.
std::vector<PlacePairs::Match> IndependentMatches(const BearingPairs& pairs) {
  PlacePairs places;
  for (size_t i = 0; i < pairs.Size(); ++i) places.Add(pairs.A(i), pairs.B(i));
  return places.Counted();
}

/// How many of some matches lie within each of the errors.
struct Counts {
  std::array<size_t, kNumErrors> within{};
  size_t all = 0;
};

class PoseTest {
 public:
  PoseTest(const Rigid3& b_from_a, double max_error_rad) : b_from_a_(b_from_a) {
    for (size_t e = 0; e < kNumErrors; ++e) errors_rad_[e] = max_error_rad / std::exp2(e);
    min_cos_far_ = std::cos(2.0 * max_error_rad);
  }

  void Count(const Vector3d& a, const Vector3d& b, Counts& counts) const {
    ++counts.all;
    const double error_rad = ErrorOf(a, b);
    for (size_t e = 0; e < kNumErrors && error_rad < errors_rad_[e]; ++e) ++counts.within[e];
  }

  [[nodiscard]] double Error(size_t e) const { return errors_rad_[e]; }
  [[nodiscard]] size_t Sample() const {
    return b_from_a_.translation.isZero() ? kRotationSample : kPoseSample;
  }

 private:
  /// Pi for what is not in front of both.
  [[nodiscard]] double ErrorOf(const Vector3d& a, const Vector3d& b) const {
    const Vector3d turned = b_from_a_.rotation * a;
    if (b_from_a_.translation.isZero()) return AngleBetween(turned, b);
    const double error_rad = SymmetricEpipolarAngle(b_from_a_, a, b);
    if (!(error_rad < errors_rad_.front())) return std::numbers::pi;
    const bool is_far = b.dot(turned) > min_cos_far_;
    return is_far || IsInFrontOfBoth(b_from_a_, a, b) ? error_rad : std::numbers::pi;
  }

  Rigid3 b_from_a_;
  std::array<double, kNumErrors> errors_rad_{};
  double min_cos_far_ = 1.0;
};

/// Exchanged matches: the i-th of one panorama with the (i + shift)-th of the other. A match whose
/// place in b is the right one's is no wrong match.
Counts CountExchanged(const std::vector<PlacePairs::Match>& matches, const PoseTest& test) {
  const size_t n = matches.size();
  const size_t num_shifts = std::min(n - 1, std::max<size_t>(1, kMaxExchanges / n));
  Counts counts;
  for (size_t shift = 1; shift <= num_shifts; ++shift) {
    for (size_t i = 0; i < n; ++i) {
      test.Count(matches[i].a, matches[(i + shift) % n].b, counts);
    }
  }
  return counts;
}

}  // namespace

MatchEvidence EvidenceOf(const BearingPairs& pairs, const Rigid3& b_from_a, double max_error_rad) {
  const std::vector<PlacePairs::Match> matches = IndependentMatches(pairs);
  MatchEvidence evidence{.max_error_rad = max_error_rad,
                         .num_matches = static_cast<uint32_t>(matches.size())};
  const PoseTest test(b_from_a, max_error_rad);
  if (matches.size() <= test.Sample()) return evidence;
  Counts found;
  for (const PlacePairs::Match& match : matches) test.Count(match.a, match.b, found);
  const Counts exchanged = CountExchanged(matches, test);
  for (size_t e = 0; e < kNumErrors; ++e) {
    // One more than was seen: what was not seen may still happen.
    const double chance =
        static_cast<double>(exchanged.within[e] + 1) / static_cast<double>(exchanged.all + 1);
    const double log10_nfa =
        Log10FalseAlarms(matches.size(), found.within[e], test.Sample(), chance, kNumErrors);
    if (e > 0 && log10_nfa >= evidence.log10_false_alarms) continue;
    evidence.log10_false_alarms = log10_nfa;
    evidence.max_error_rad = test.Error(e);
    evidence.num_inliers = static_cast<uint32_t>(found.within[e]);
    evidence.chance_share = chance;
  }
  return evidence;
}

double SmallestTellingShare(size_t num_matches,
                            double max_error_rad,
                            double max_log10_false_alarms) {
  const double chance = 0.5 * std::sin(max_error_rad / std::exp2(kNumErrors - 1));
  for (size_t k = kPoseSample + 1; k < num_matches; ++k) {
    if (Log10FalseAlarms(num_matches, k, kPoseSample, chance, kNumErrors) <=
        max_log10_false_alarms) {
      return static_cast<double>(k) / static_cast<double>(num_matches);
    }
  }
  return 1.0;
}

}  // namespace orbweave
