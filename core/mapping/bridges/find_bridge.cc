// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/bridges/find_bridge.h"

#include <algorithm>
#include <limits>
#include <set>

#include "core/geometry/rotation.h"
#include "core/mapping/bridges/bridge_terms.h"
#include "core/mapping/positioning/place_on_gnss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMaxTurnRad = 2.0 * kTurnSigmaRad;
/// A wrong direction comes so near to another in 3 of 100 cases.
constexpr double kMaxDirectionRad = 4.0 * kDirectionSigmaRad;
constexpr double kMinAgreeingMatches = 0.5;
constexpr double kMaxLogScaleSigma = 0.2;
constexpr double kMaxPlaceSigma = 0.5;  ///< share of the shortest baseline
constexpr double kMinAgreeingSights = 0.5;
constexpr double kMaxSigmas = 3.0;
constexpr double kEndsShare = 0.5;
constexpr size_t kPairsWithoutGnss = 3;
constexpr size_t kImagesWithoutGnss = 2;

/// Mean of the centres of one submodel's images in pairs.
Vector3d MeanCentre(const MappingState& state,
                    const std::vector<BridgePair>& pairs,
                    ImageSlot BridgePair::*end) {
  Vector3d sum = Vector3d::Zero();
  for (const BridgePair& pair : pairs) sum += state.Centre(pair.*end);
  return sum / static_cast<double>(pairs.size());
}

/// One try to place b in the frame of a.
class Bridging {
 public:
  Bridging(const MappingState& a, const MappingState& b, const MappingOptions& options)
      : a_(a),
        b_(b),
        options_(options),
        all_(BridgePairsOf(a, b)),
        pairs_(PairsThatTurnAlike(all_, kMaxTurnRad)) {
    if (!HasMatchesEnough()) return;
    enu_from_a_ = PlaceOnGnss(a_, ImagesNear(a_, MeanCentre(a_, pairs_, &BridgePair::in_a)));
    origin_in_b_ = MeanCentre(b_, pairs_, &BridgePair::in_b);
    near_in_b_ = ImagesNear(b_, origin_in_b_);
    terms_ = TermsOf(a_, b_, pairs_, origin_in_b_, near_in_b_, enu_from_a_, options_.max_error_px);
  }

  /// Whether GNSS places a near the pairs, and says of b where it is.
  [[nodiscard]] bool HasGnss() const { return !terms_.fixes.empty(); }

  [[nodiscard]] std::optional<Sim3> Find() const {
    if (!HasMatchesEnough()) return std::nullopt;
    const std::vector<Sim3> starts = Starts();
    std::optional<Sim3> a_from_b = FindByPoints(starts);
    if (!a_from_b) a_from_b = FindByBothEnds(starts);
    if (!a_from_b) return std::nullopt;
    return *a_from_b * Sim3{.translation = -origin_in_b_};
  }

 private:
  static size_t CountMatches(const std::vector<BridgePair>& pairs) {
    size_t matches = 0;
    for (const BridgePair& pair : pairs) matches += pair.matches;
    return matches;
  }

  [[nodiscard]] bool HasMatchesEnough() const { return CountMatches(pairs_) >= NeededMatches(); }

  /// Half of all, and enough in themselves.
  [[nodiscard]] size_t NeededMatches() const {
    return std::max(
        2 * static_cast<size_t>(options_.min_inliers),
        static_cast<size_t>(kMinAgreeingMatches * static_cast<double>(CountMatches(all_))));
  }

  /// The best fit of all starts, where it is determined and supported.
  [[nodiscard]] std::optional<Sim3> FindByPoints(const std::vector<Sim3>& starts) const {
    std::optional<FittedBridge> best;
    for (const Sim3& start : starts) {
      const FittedBridge fitted = FitBridge(terms_, start);
      if (!best || fitted.cost < best->cost) best = fitted;
    }
    if (!best || !IsDetermined(*best) || !IsSupported(best->a_from_b)) return std::nullopt;
    return best->a_from_b;
  }

  /// As directions of the pairs and GNSS have it, whatever points say: of all starts the one from
  /// which pairs with most matches come to agree.
  [[nodiscard]] std::optional<Sim3> FindByBothEnds(const std::vector<Sim3>& starts) const {
    if (!HasGnss()) return std::nullopt;
    const BridgeTerms terms =
        TermsOf(a_, b_, pairs_, origin_in_b_, near_in_b_, enu_from_a_, std::nullopt);
    std::optional<Sim3> found;
    size_t most = NeededMatches() - 1;
    for (const Sim3& start : starts) {
      const FittedBridge fitted = FitBridge(terms, start);
      const std::vector<BridgePair> agreeing = Agreeing(fitted.a_from_b);
      const size_t matches = CountMatches(agreeing);
      if (matches <= most || !IsDetermined(fitted) ||
          !AreAtBothEnds(agreeing, fitted.a_from_b.scale) || !FixesAgree(fitted.a_from_b))
        continue;
      found = fitted.a_from_b;
      most = matches;
    }
    return found;
  }

  [[nodiscard]] std::vector<BridgePair> Agreeing(const Sim3& a_from_b) const {
    std::vector<BridgePair> agreeing;
    for (const BridgePair& pair : all_) {
      if (Agrees(pair, a_from_b)) agreeing.push_back(pair);
    }
    return agreeing;
  }

  /// From where GNSS puts both, and from each pair's own lengths.
  [[nodiscard]] std::vector<Sim3> Starts() const {
    std::vector<Sim3> starts;
    const Eigen::Quaterniond turn = pairs_.front().a_from_b;
    if (enu_from_a_) {
      const std::optional<Sim3> enu_from_b = PlaceOnGnss(b_, near_in_b_);
      if (enu_from_b) {
        const Sim3 a_from_b = enu_from_a_->Inverse() * *enu_from_b;
        starts.push_back({a_from_b.scale, turn, a_from_b * origin_in_b_});
      } else if (!terms_.fixes.empty()) {
        starts.push_back({ScaleOfFixes(), turn, MeanFix()});
      }
    }
    for (const BridgePair& pair : pairs_) {
      const BridgeLengths lengths = LengthsOf(a_, b_, pair);
      const bool is_known = lengths.in_a > 0.0 && (lengths.in_b > 0.0 || terms_.b_is_one_camera);
      if (is_known) starts.push_back(StartOf(pair, lengths));
    }
    return starts;
  }

  [[nodiscard]] Vector3d MeanFix() const {
    Vector3d sum = Vector3d::Zero();
    for (const BridgeFix& fix : terms_.fixes) sum += fix.position_in_enu;
    return enu_from_a_->Inverse() * Vector3d(sum / static_cast<double>(terms_.fixes.size()));
  }

  /// From how far b's cameras and their positions spread.
  [[nodiscard]] double ScaleOfFixes() const {
    double in_b = 0.0;
    double in_enu = 0.0;
    for (const BridgeFix& fix : terms_.fixes) {
      in_b += (fix.centre_in_b - terms_.fixes.front().centre_in_b).norm();
      in_enu += (fix.position_in_enu - terms_.fixes.front().position_in_enu).norm();
    }
    const bool is_known = in_b > 0.0 && in_enu > 0.0;
    return (is_known ? in_enu / in_b : 1.0) / enu_from_a_->scale;
  }

  [[nodiscard]] Sim3 StartOf(const BridgePair& pair, const BridgeLengths& lengths) const {
    const Rigid3& cam = a_.CamFromWorld(pair.in_a);
    const Vector3d centre_of_b =
        cam.Centre() + lengths.in_a * (cam.rotation.conjugate() * pair.direction_in_cam_a);
    Sim3 start{
        lengths.in_b > 0.0 ? lengths.in_a / lengths.in_b : 1.0, pair.a_from_b, Vector3d::Zero()};
    start.translation = centre_of_b - start * (b_.Centre(pair.in_b) - origin_in_b_);
    return start;
  }

  [[nodiscard]] Vector3d CentreOfB(const Sim3& a_from_b, ImageSlot image) const {
    return a_from_b * (b_.Centre(image) - origin_in_b_);
  }

  [[nodiscard]] bool IsDetermined(const FittedBridge& fitted) const {
    if (!terms_.b_is_one_camera) return fitted.log_scale_sigma <= kMaxLogScaleSigma;
    double shortest = std::numeric_limits<double>::infinity();
    for (const BridgePair& pair : pairs_) {
      shortest =
          std::min(shortest, (CentreOfB(fitted.a_from_b, pair.in_b) - a_.Centre(pair.in_a)).norm());
    }
    return fitted.translation_sigma <= kMaxPlaceSigma * shortest;
  }

  [[nodiscard]] bool Agrees(const BridgePair& pair, const Sim3& a_from_b) const {
    if (RotationAngle(pair.a_from_b.conjugate() * a_from_b.rotation) > kMaxTurnRad) return false;
    if (pair.direction_in_cam_a.isZero()) return true;
    const Vector3d baseline = CentreOfB(a_from_b, pair.in_b) - a_.Centre(pair.in_a);
    return AngleBetween(a_.CamFromWorld(pair.in_a).rotation * baseline, pair.direction_in_cam_a) <=
           kMaxDirectionRad;
  }

  [[nodiscard]] bool IsSupported(const Sim3& a_from_b) const {
    const std::vector<BridgePair> agreeing = Agreeing(a_from_b);
    if (CountMatches(agreeing) < NeededMatches()) return false;
    if (!SightsAgree(a_from_b)) return false;
    if (!terms_.fixes.empty()) return FixesAgree(a_from_b);
    std::set<ImageSlot> in_a;
    std::set<ImageSlot> in_b;
    for (const BridgePair& pair : agreeing) {
      in_a.insert(pair.in_a);
      in_b.insert(pair.in_b);
    }
    return agreeing.size() >= kPairsWithoutGnss && in_a.size() >= kImagesWithoutGnss &&
           in_b.size() >= kImagesWithoutGnss;
  }

  /// Whether two of the pairs have their images in b half of its length or more apart, and those in
  /// a as far.
  [[nodiscard]] bool AreAtBothEnds(const std::vector<BridgePair>& agreeing,
                                   double a_from_b_scale) const {
    const double apart_in_b = kEndsShare * LengthOfB();
    const double apart_in_a = apart_in_b * a_from_b_scale;
    for (const BridgePair& one : agreeing) {
      for (const BridgePair& other : agreeing) {
        if (one.direction_in_cam_a.isZero() || other.direction_in_cam_a.isZero()) continue;
        const double in_b = (b_.Centre(one.in_b) - b_.Centre(other.in_b)).norm();
        const double in_a = (a_.Centre(one.in_a) - a_.Centre(other.in_a)).norm();
        if (in_b > 0.0 && in_b >= apart_in_b && in_a >= apart_in_a) return true;
      }
    }
    return false;
  }

  /// The largest distance between two images.
  [[nodiscard]] double LengthOfB() const {
    double longest = 0.0;
    for (const ImageSlot one : b_.Registered()) {
      for (const ImageSlot other : b_.Registered())
        longest = std::max(longest, (b_.Centre(one) - b_.Centre(other)).norm());
    }
    return longest;
  }

  /// Of the points that the pairs say the other side sees.
  [[nodiscard]] bool SightsAgree(const Sim3& a_from_b) const {
    const std::vector<double> errors = SightErrors(terms_, a_from_b);
    const auto agreeing = std::ranges::count_if(errors, [](double e) { return e <= kMaxSigmas; });
    return static_cast<double>(agreeing) >= kMinAgreeingSights * static_cast<double>(errors.size());
  }

  [[nodiscard]] bool FixesAgree(const Sim3& a_from_b) const {
    size_t agreeing = 0;
    for (const BridgeFix& fix : terms_.fixes) {
      const Vector3d error = *enu_from_a_ * (a_from_b * fix.centre_in_b) - fix.position_in_enu;
      agreeing += error.head<2>().norm() <= kMaxFixSigmas * fix.sigma_m.x() ? 1U : 0U;
    }
    return static_cast<double>(agreeing) >=
           kMinAgreeingFixes * static_cast<double>(terms_.fixes.size());
  }

  const MappingState& a_;
  const MappingState& b_;
  const MappingOptions& options_;
  const std::vector<BridgePair> all_;
  const std::vector<BridgePair> pairs_;
  Vector3d origin_in_b_ = Vector3d::Zero();
  std::vector<ImageSlot> near_in_b_{};
  std::optional<Sim3> enu_from_a_{};
  BridgeTerms terms_{};
};

}  // namespace

std::optional<Sim3> FindBridge(const MappingState& a,
                               const MappingState& b,
                               const MappingOptions& options) {
  Bridging from_a(a, b, options);
  if (from_a.HasGnss() || b.Registered().size() == 1) return from_a.Find();
  Bridging from_b(b, a, options);
  if (!from_b.HasGnss()) return from_a.Find();
  const std::optional<Sim3> b_from_a = from_b.Find();
  return b_from_a ? std::optional(b_from_a->Inverse()) : std::nullopt;
}

}  // namespace orbweave
