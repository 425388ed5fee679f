// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/match_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/epipolar.h"
#include "core/geometry/rotation.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kPoseSample = 5;
constexpr size_t kRotationSample = 2;
constexpr size_t kNumErrors = 4;
/// A window of a facade 10 m away. Features of one thing that is taken for another move together
/// over about this much; over more, two things that only look alike part.
constexpr double kSamePlaceRad = 2.0 * std::numbers::pi / 180.0;
/// Exchanged matches per match at most: with 256 the share of chance is known to a tenth where it
/// is a hundredth.
constexpr size_t kMaxExchanges = 256;

/// Matches that are not next to another one in both panoramas.
class IndependentMatches {
 public:
  explicit IndependentMatches(const BearingPairs& pairs) {
    for (size_t i = 0; i < pairs.Size(); ++i) Add(pairs.A(i), pairs.B(i));
  }

  [[nodiscard]] const std::vector<std::pair<Vector3d, Vector3d>>& All() const { return kept_; }

 private:
  using Cell = std::array<int, 3>;

  static Cell CellOf(const Vector3d& bearing) {
    const Vector3d scaled = bearing / kSamePlaceRad;
    return {static_cast<int>(std::floor(scaled.x())),
            static_cast<int>(std::floor(scaled.y())),
            static_cast<int>(std::floor(scaled.z()))};
  }

  void Add(const Vector3d& a, const Vector3d& b) {
    const Cell cell = CellOf(a);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (IsTaken({cell[0] + x, cell[1] + y, cell[2] + z}, a, b)) return;
        }
      }
    }
    cells_[cell].push_back(kept_.size());
    kept_.emplace_back(a, b);
  }

  [[nodiscard]] bool IsTaken(const Cell& cell, const Vector3d& a, const Vector3d& b) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return false;
    return std::ranges::any_of(found->second, [&](size_t i) {
      return (kept_[i].first - a).norm() < kSamePlaceRad &&
             (kept_[i].second - b).norm() < kSamePlaceRad;
    });
  }

  std::map<Cell, std::vector<size_t>> cells_{};
  std::vector<std::pair<Vector3d, Vector3d>> kept_{};
};

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
Counts CountExchanged(const std::vector<std::pair<Vector3d, Vector3d>>& matches,
                      const PoseTest& test) {
  const size_t n = matches.size();
  const size_t num_shifts = std::min(n - 1, kMaxExchanges);
  Counts counts;
  for (size_t shift = 1; shift <= num_shifts; ++shift) {
    for (size_t i = 0; i < n; ++i) {
      test.Count(matches[i].first, matches[(i + shift) % n].second, counts);
    }
  }
  return counts;
}

}  // namespace

MatchEvidence EvidenceOf(const BearingPairs& pairs, const Rigid3& b_from_a, double max_error_rad) {
  const IndependentMatches independent(pairs);
  const auto& matches = independent.All();
  MatchEvidence evidence{.max_error_rad = max_error_rad,
                         .num_matches = static_cast<uint32_t>(matches.size())};
  const PoseTest test(b_from_a, max_error_rad);
  if (matches.size() <= test.Sample()) return evidence;
  Counts found;
  for (const auto& [a, b] : matches) test.Count(a, b, found);
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
