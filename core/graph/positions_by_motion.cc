// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/positions_by_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/base/quantile.h"
#include "core/graph/smooth_motion.h"
#include "core/robust/loss.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

/// Braking and turning change the speed of a car by 3 m/s within a second, as one sigma.
constexpr double kDensity_m2_s3 = 9.0;
/// Heights change by slopes: of a tenth at 10 m/s within a second.
constexpr double kHeightDensity_m2_s3 = 1.0;
constexpr double kMaxSpeed_m_s = 60.0;
constexpr size_t kFewestPositions = 5;
/// Fewer do not prove that they are better than stated.
constexpr size_t kMany = 20;
constexpr double kSmallestScale = 0.1;
constexpr double kLargestScale = 100.0;
/// No receiver is so much worse than it states: its positions are not those of a motion.
constexpr double kLargestSoundScale = 10.0;
constexpr int kIterations = 20;
constexpr double kMaxSigmas = 4.0;
constexpr double kMaxShareOff = 0.3;
constexpr double kMaxSigma_m = 50.0;

/// Measured values of one drive in order of time; axes share their sigma.
struct Track {
  std::vector<double> times_s{};
  Eigen::MatrixXd values{};    ///< a row per image, a column per axis
  Eigen::VectorXd sigmas_m{};  ///< infinite: not measured
  double sigma_of_times_s = 0.0;
};

/// What times say is as coarse as whole seconds, or not coarse at all.
double SigmaOfTimes(std::span<const double> times_s) {
  const bool is_whole =
      std::ranges::all_of(times_s, [](double time_s) { return time_s == std::floor(time_s); });
  return is_whole ? 1.0 / std::sqrt(12.0) : 0.0;
}

/// The median of what normal errors of `axes` axes are long, in sigmas.
double MedianLength(Eigen::Index axes) { return axes == 1 ? 0.6745 : 1.1774; }

/// Smooths again and again, with what the last time told of each measurement.
class TrackSmoother {
 public:
  TrackSmoother(const Track& track, double density)
      : track_(track),
        density_(density),
        typical_sigma_m_(Quantile({track.sigmas_m.begin(), track.sigmas_m.end()}, 0.5)),
        weights_(Eigen::VectorXd::Ones(track.sigmas_m.size())),
        speed_m_s_(Eigen::VectorXd::Zero(track.sigmas_m.size())),
        ratio_(Eigen::VectorXd::Ones(speed_m_s_.size())) {}

  void Run() {
    for (int i = 0; i < kIterations; ++i) {
      smoothed_ = SmoothMotion(
          track_.times_s, track_.values, Variances().cwiseQuotient(weights_), density_);
      speed_m_s_ = smoothed_.speeds.rowwise().norm();
      Reweight();
    }
  }

  [[nodiscard]] bool IsSound() const {
    std::vector<double> speeds(speed_m_s_.begin(), speed_m_s_.end());
    size_t off = 0;
    for (const double error : errors_) off += error > kMaxSigmas ? 1 : 0;
    return scale_ <= kLargestSoundScale && Quantile(std::move(speeds), 0.5) <= kMaxSpeed_m_s &&
           static_cast<double>(off) <= kMaxShareOff * static_cast<double>(errors_.size());
  }
  /// Of the image, which was taken at a time that may be known to a second only: what was measured
  /// is where it was, give or take what measurements are off, and the others say so less well the
  /// less is known of its time.
  [[nodiscard]] Eigen::VectorXd Position(Eigen::Index i) const {
    const Eigen::VectorXd measured = track_.values.row(i).transpose();
    const Eigen::VectorXd smoothed = smoothed_.positions.row(i).transpose();
    return measured + ShareOfOthers(i) * ratio_[i] * (smoothed - measured);
  }
  /// Neighbours share what their smoothed positions are off. So that who takes them for independent
  /// does not believe more than was measured, none is better than one measurement. And where a
  /// measurement and the motion are apart, but not so far that it is clear which is wrong, both may
  /// be: at the end of a drive one cannot tell.
  [[nodiscard]] double Sigma_m(Eigen::Index i) const {
    const double told_m = std::sqrt(ShareOfOthers(i) * VarianceAtImage(i));
    const bool is_apart = std::isfinite(given_[i]) && weights_[i] > kRejected;
    const double apart_m = is_apart ? (track_.values.row(i).transpose() - Position(i)).norm() : 0.0;
    return std::max({told_m, scale_ * typical_sigma_m_, apart_m});
  }
  /// Whether the others alone tell the place about as well as a measurement is said to.
  [[nodiscard]] bool IsToldByOthers(Eigen::Index i) const {
    const double measured_m = std::max(scale_, 1.0) * typical_sigma_m_;
    return std::sqrt(VarianceAtImage(i)) <= kAboutAsWell * measured_m;
  }

 private:
  [[nodiscard]] double SigmaByTime(Eigen::Index i) const {
    return track_.sigma_of_times_s * speed_m_s_[i];
  }
  /// Of where the others have the image.
  [[nodiscard]] double VarianceAtImage(Eigen::Index i) const {
    return variance_by_others_[i] + SigmaByTime(i) * SigmaByTime(i);
  }
  /// What they weigh against the measurement, whose error has what was given to both it and its
  /// time, less the time's.
  [[nodiscard]] double ShareOfOthers(Eigen::Index i) const {
    if (!std::isfinite(given_[i])) return 1.0;
    const double measured = std::max(given_[i] - SigmaByTime(i) * SigmaByTime(i), 0.0);
    return measured / (measured + VarianceAtImage(i));
  }
  [[nodiscard]] Eigen::VectorXd Variances() const {
    Eigen::VectorXd variances(track_.sigmas_m.size());
    for (Eigen::Index i = 0; i < variances.size(); ++i) {
      const double sigma_m = std::hypot(scale_ * track_.sigmas_m[i], SigmaByTime(i));
      variances[i] = sigma_m * sigma_m;
    }
    return variances;
  }

  /// Errors in sigmas, each from what all others say of its place: with variance R' given to a
  /// measurement and P of the result, the others alone have P R' / (R' - P), and their result lies
  /// R' / (R' - P) times as far from the measurement.
  void Reweight() {
    const Eigen::VectorXd variances = Variances();
    variance_by_others_ = smoothed_.variances;
    given_ = variances.cwiseQuotient(weights_);
    errors_.clear();
    for (Eigen::Index i = 0; i < variances.size(); ++i) {
      if (!std::isfinite(variances[i])) continue;
      ratio_[i] = given_[i] / std::max(given_[i] - smoothed_.variances[i], 1e-6 * given_[i]);
      variance_by_others_[i] *= ratio_[i];
      const double apart_m = (track_.values.row(i) - smoothed_.positions.row(i)).norm();
      const double error = ratio_[i] * apart_m / std::sqrt(variances[i] + variance_by_others_[i]);
      weights_[i] = kLoss.Weight(error * error);
      errors_.push_back(error);
    }
    scale_ *= Quantile(errors_, 0.5) / MedianLength(track_.values.cols());
    scale_ = std::clamp(scale_, SmallestScale(), kLargestScale);
  }

  /// Measurements are no better than their errors prove: the variance of n errors is known to
  /// sqrt(2 / n), and where coarse times make most of it, so is what is left for measurements.
  [[nodiscard]] double SmallestScale() const {
    if (errors_.size() < kMany) return 1.0;
    const auto n = static_cast<double>(track_.values.cols()) * static_cast<double>(errors_.size());
    const double by_time_m =
        track_.sigma_of_times_s * Quantile({speed_m_s_.begin(), speed_m_s_.end()}, 0.5);
    const double proven_m = std::sqrt(kProvenSigmas * std::sqrt(2.0 / n)) * by_time_m;
    return std::clamp(proven_m / typical_sigma_m_, kSmallestScale, 1.0);
  }

  /// The last position of a drive, which one neighbour contradicts, must not pull that along.
  static constexpr GemanMcClureLoss kLoss{3.0};
  static constexpr double kRejected = 0.05;
  static constexpr double kAboutAsWell = 3.0;
  static constexpr double kProvenSigmas = 2.0;
  const Track& track_;
  double density_;
  double typical_sigma_m_;
  double scale_ = 1.0;
  SmoothedMotion smoothed_{};
  Eigen::VectorXd weights_;
  Eigen::VectorXd speed_m_s_;
  Eigen::VectorXd given_{};  ///< variances of measurements, times' and weights' part included
  Eigen::VectorXd ratio_;    ///< how many times as far from the measurement the others have it
  Eigen::VectorXd variance_by_others_{};
  std::vector<double> errors_{};
};

size_t CountPositions(const ImageManifest& manifest, std::span<const ImageId> sequence) {
  return static_cast<size_t>(std::ranges::count_if(
      sequence, [&](ImageId id) { return manifest.At(id).prior.position_in_enu.has_value(); }));
}

/// Axes `first` and on of the positions of a drive.
Track TrackOf(const ImageManifest& manifest,
              std::span<const ImageId> sequence,
              Eigen::Index first,
              Eigen::Index axes) {
  const auto size = static_cast<Eigen::Index>(sequence.size());
  Track track{.values = Eigen::MatrixXd::Zero(size, axes), .sigmas_m = Eigen::VectorXd(size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    const ImageRecord& image = manifest.At(sequence[static_cast<size_t>(i)]);
    const PosePrior& prior = image.prior;
    track.times_s.push_back(*image.capture_time_s);
    track.sigmas_m[i] = !prior.position_in_enu ? std::numeric_limits<double>::infinity()
                        : first == 0           ? prior.horizontal_sigma_m
                                               : prior.vertical_sigma_m;
    if (prior.position_in_enu)
      track.values.row(i) = prior.position_in_enu->segment(first, axes).transpose();
  }
  track.sigma_of_times_s = SigmaOfTimes(track.times_s);
  return track;
}

/// `sequence`: images with times.
void SmoothDrive(const ImageManifest& manifest,
                 std::span<const ImageId> sequence,
                 std::vector<PositionByMotion>& positions) {
  if (CountPositions(manifest, sequence) < kFewestPositions) return;
  const Track plan = TrackOf(manifest, sequence, 0, 2);
  const Track heights = TrackOf(manifest, sequence, 2, 1);
  if (!(plan.times_s.front() < plan.times_s.back())) return;
  TrackSmoother in_plan(plan, kDensity_m2_s3);
  TrackSmoother in_height(heights, kHeightDensity_m2_s3);
  in_plan.Run();
  in_height.Run();
  if (!in_plan.IsSound() || !in_height.IsSound()) return;
  for (size_t k = 0; k < sequence.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (in_plan.Sigma_m(i) > kMaxSigma_m) continue;
    positions[sequence[k].value].is_of_drive = in_plan.IsToldByOthers(i);
    PosePrior& prior = positions[sequence[k].value].prior;
    prior.position_in_enu.emplace();
    *prior.position_in_enu << in_plan.Position(i), in_height.Position(i);
    prior.horizontal_sigma_m = in_plan.Sigma_m(i);
    prior.vertical_sigma_m = in_height.Sigma_m(i);
  }
}

}  // namespace

std::vector<PositionByMotion> PositionsByMotion(const ImageManifest& manifest) {
  std::vector<PositionByMotion> positions;
  for (const ImageRecord& image : manifest.images) positions.push_back({.prior = image.prior});
  for (const auto& [drive, sequence] : SequenceOfDrives(manifest))
    SmoothDrive(manifest, TimedAmong(manifest, sequence), positions);
  return positions;
}

}  // namespace orbweave
