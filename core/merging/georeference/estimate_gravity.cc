// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/estimate_gravity.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/merging/georeference/drive_attitudes.h"
#include "core/merging/georeference/find_gravity.h"

namespace orbweave {
namespace {

// What a drive can know of down in its cameras: roads slope and bank by some per cent, for long; by
// more where that shows in what its cameras scatter.
constexpr double kRoadSigma_rad = 0.02;
// Of the ground as a whole: carriers stand at right angles to it, and hillsides slope by as much as
// towns are built on.
constexpr double kGroundSigma_rad = 0.05;
constexpr double kLeastScatter_rad = 1e-3;
// What turns panoramas to one heading, a program or somebody who looks, levels them as well.
constexpr double kLevelledSigma_rad = 0.05;
// A mount that leans on flat ground explains nearly all that neighbours lean alike, hills under an
// upright one leave most of it; less than half may be either.
constexpr double kExplainedShare = 0.15;
constexpr double kEitherShare = 0.5;
constexpr int kRounds = 20;
constexpr int kSteps = 30;

// Of d_k about y, in any direction.
double MountSigma_rad(const DriveAttitudes& drive) {
  return drive.stated_sigma_rad.value_or(drive.keeps_heading ? kLevelledSigma_rad
                                                             : kMountSigma_rad);
}

// A drive's part of the cost with d_k eliminated:
//   g^T Q g - |S g + u y|^2_M^-1,   M = W + u I.
struct DriveTerm {
  Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();  // sum of R_i^T W_i R_i
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();  // sum of W_i R_i
  Eigen::Matrix3d W = Eigen::Matrix3d::Zero();  // sum of W_i
  double u = 1.0;
  bool is_of_mount = true;  // u

  [[nodiscard]] Eigen::Matrix3d InverseM() const {
    return (W + u * Eigen::Matrix3d::Identity()).inverse();
  }
  [[nodiscard]] Eigen::Vector3d DownInMount(const Eigen::Vector3d& down) const {
    return InverseM() * (S * down + u * Eigen::Vector3d::UnitY());
  }
  // Of that, in the direction known worst, where down is known to `down_sigma_rad`.
  [[nodiscard]] double MountSigma_rad(const Eigen::Vector3d& in_mount,
                                      double down_sigma_rad) const {
    const Eigen::Matrix<double, 3, 2> basis = TangentBasis(in_mount.normalized());
    const Eigen::Vector2d weights = EigenOf<2>(basis.transpose() * W * basis).values;
    const double least = std::max(weights[0], 0.0);
    const double most = std::max(weights[1], 0.0);
    return std::hypot(1.0 / std::sqrt(least + u), most / (most + u) * down_sigma_rad);
  }
};

double CostOf(const std::vector<DriveTerm>& terms, const Eigen::Vector3d& down) {
  double cost = 0.0;
  for (const DriveTerm& term : terms) {
    const Eigen::Vector3d b = term.S * down + term.u * Eigen::Vector3d::UnitY();
    cost += down.dot(term.Q * down) - b.dot(term.InverseM() * b);
  }
  return cost;
}

// Minus half the derivative of the cost.
Eigen::Vector3d AscentOf(const std::vector<DriveTerm>& terms, const Eigen::Vector3d& down) {
  Eigen::Vector3d ascent = Eigen::Vector3d::Zero();
  for (const DriveTerm& term : terms)
    ascent += term.S.transpose() * term.DownInMount(down) - term.Q * down;
  return ascent;
}

// Half the second derivative on the sphere: information about `down` in its tangent plane.
Eigen::Matrix2d InformationOf(const std::vector<DriveTerm>& terms, const Eigen::Vector3d& down) {
  const Eigen::Matrix<double, 3, 2> basis = TangentBasis(down);
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  for (const DriveTerm& term : terms)
    hessian += term.Q - term.S.transpose() * term.InverseM() * term.S;
  return basis.transpose() * hessian * basis +
         down.dot(AscentOf(terms, down)) * Eigen::Matrix2d::Identity();
}

double SigmaOf(const std::vector<DriveTerm>& terms, const Eigen::Vector3d& down) {
  return 1.0 / std::sqrt(std::max(EigenOf<2>(InformationOf(terms, down)).values[0], 1.0));
}

// What would be known less if mounts leaned anyhow, as a share; of the direction known worst.
double MountShare(std::vector<DriveTerm> terms, const Eigen::Vector3d& down) {
  const double sigma_rad = SigmaOf(terms, down);
  for (DriveTerm& term : terms) term.u = term.is_of_mount ? 0.0 : term.u;
  return 1.0 - std::clamp(std::pow(sigma_rad / SigmaOf(terms, down), 2), 0.0, 1.0);
}

// Levenberg-Marquardt on the sphere; two unknowns.
Eigen::Vector3d Minimise(const std::vector<DriveTerm>& terms, Eigen::Vector3d down) {
  double damping = 1e-6;
  double cost = CostOf(terms, down);
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Matrix<double, 3, 2> basis = TangentBasis(down);
    double weight = 0.0;
    for (const DriveTerm& term : terms) weight += term.W.trace() / 3.0;
    const Eigen::Matrix2d A =
        InformationOf(terms, down) + damping * weight * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d move = A.ldlt().solve(basis.transpose() * AscentOf(terms, down));
    const Eigen::Vector3d candidate = (down + basis * move).normalized();
    const double candidate_cost = CostOf(terms, candidate);
    if (candidate.allFinite() && candidate_cost <= cost) {
      down = candidate;
      cost = candidate_cost;
      damping *= 0.1;
      if (move.norm() < 1e-12) break;
    } else {
      damping = std::max(10.0 * damping, 1e-9);
    }
  }
  return down;
}

// How what cameras lean scatters in one direction: in all, and from one to the next.
class Scatter {
 public:
  void Add(double lean, bool follows) {
    if (follows) steps_.push_back(std::abs(lean - last_));
    leans_.push_back(std::abs(lean));
    last_ = lean;
  }
  [[nodiscard]] const std::vector<double>& Leans() const { return leans_; }
  [[nodiscard]] const std::vector<double>& Steps() const { return steps_; }

 private:
  std::vector<double> leans_{};
  std::vector<double> steps_{};
  double last_ = 0.0;
};

// What that makes of one camera's word, and of all of a drive.
class Spread {
 public:
  explicit Spread(const Scatter& scatter)
      : median_rad_(std::max(Quantile(scatter.Leans(), 0.5), kLeastScatter_rad)) {
    if (scatter.Steps().empty()) return;
    const double step_rad = Quantile(scatter.Steps(), 0.5);
    const double alike = median_rad_ * median_rad_ - 0.5 * step_rad * step_rad;
    alike_rad_ = std::sqrt(std::max(alike, 0.0));
  }

  [[nodiscard]] double Weight(double lean) const {
    return 1.0 / (median_rad_ * median_rad_ + lean * lean);
  }
  /// What neighbours lean alike: it does not average out.
  [[nodiscard]] double Alike_rad() const { return alike_rad_; }

 private:
  double median_rad_;
  double alike_rad_ = 0.0;
};

class Estimate {
 public:
  // `on_hills`: what neighbours lean alike are slopes.
  Estimate(const std::vector<DriveAttitudes>& drives, const Eigen::Vector3d& start, bool on_hills)
      : drives_(drives), on_hills_(on_hills), down_(start) {
    for (const DriveAttitudes& drive : drives) {
      terms_.push_back(
          {.u = 1.0 / std::pow(MountSigma_rad(drive), 2), .is_of_mount = !drive.keeps_heading});
      in_mount_.push_back(MeanDown(drive));
    }
  }

  void Run() {
    for (int round = 0; round < kRounds; ++round) {
      Reweigh();
      down_ = Minimise(terms_, down_);
      for (size_t k = 0; k < terms_.size(); ++k) in_mount_[k] = terms_[k].DownInMount(down_);
      Forgive();
    }
  }

  [[nodiscard]] const Eigen::Vector3d& Down() const { return down_; }

  // What is left that neighbours lean alike.
  [[nodiscard]] double Alike_rad() const {
    const auto [along, across] = Spreads();
    return std::hypot(along.Alike_rad(), across.Alike_rad());
  }

  [[nodiscard]] Gravity Found() const {
    Gravity gravity{.down_in_world = down_};
    gravity.sigma_rad = Sigma_rad();
    gravity.mount_share = MountShare(terms_, down_);
    for (size_t k = 0; k < drives_.size(); ++k) {
      gravity.down_in_mount[drives_[k].drive] = in_mount_[k].normalized();
      gravity.mount_sigma_rad[drives_[k].drive] =
          terms_[k].MountSigma_rad(in_mount_[k], gravity.sigma_rad);
    }
    return gravity;
  }

 private:
  [[nodiscard]] Eigen::Vector3d MeanDown(const DriveAttitudes& drive) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Matrix3d& R : drive.level_from_world) sum += R * down_;
    return sum / static_cast<double>(drive.level_from_world.size());
  }

  // Ground that slopes as a whole looks level to everything that drives on it, not to what states
  // pitch and roll.
  [[nodiscard]] double Sigma_rad() const {
    std::vector<DriveTerm> stated;
    for (size_t k = 0; k < terms_.size(); ++k) {
      if (drives_[k].stated_sigma_rad) stated.push_back(terms_[k]);
    }
    const double sigma_rad = std::max(SigmaOf(terms_, down_), kGroundSigma_rad);
    return stated.empty() ? sigma_rad : std::min(sigma_rad, SigmaOf(stated, down_));
  }

  // Cauchy's weights at the scatter of all, along the way and across it.
  void Reweigh() {
    const auto [along, across] = Spreads();
    for (size_t k = 0; k < drives_.size(); ++k) Reweigh(k, along, across);
  }

  [[nodiscard]] std::pair<Spread, Spread> Spreads() const {
    Scatter along;
    Scatter across;
    for (size_t k = 0; k < drives_.size(); ++k) {
      for (size_t i = 0; i < drives_[k].images.size(); ++i) {
        const Leaning leaning = LeaningOf(k, i);
        along.Add(leaning.along, i > 0);
        across.Add(leaning.across, i > 0);
      }
    }
    return {Spread(along), Spread(across)};
  }

  // No drive weighs more than its slopes allow.
  [[nodiscard]] double MostOfADrive(const Spread& spread) const {
    return std::pow(std::max(kRoadSigma_rad, on_hills_ ? spread.Alike_rad() : 0.0), -2);
  }

  void Reweigh(size_t k, const Spread& of_along, const Spread& of_across) {
    double sum_along = 0.0;
    double sum_across = 0.0;
    for (size_t i = 0; i < drives_[k].images.size(); ++i) {
      const Leaning leaning = LeaningOf(k, i);
      sum_along += of_along.Weight(leaning.along);
      sum_across += of_across.Weight(leaning.across);
    }
    const double share_along = std::min(1.0, MostOfADrive(of_along) / sum_along);
    const double share_across = std::min(1.0, MostOfADrive(of_across) / sum_across);
    DriveTerm& term = terms_[k];
    term = {.u = term.u, .is_of_mount = term.is_of_mount};
    for (size_t i = 0; i < drives_[k].images.size(); ++i) {
      const Leaning leaning = LeaningOf(k, i);
      const double w_along = share_along * of_along.Weight(leaning.along);
      const double w_across = share_across * of_across.Weight(leaning.across);
      const Eigen::Matrix3d W = w_along * leaning.along_way +
                                w_across * (Eigen::Matrix3d::Identity() - leaning.along_way);
      const Eigen::Matrix3d& R = drives_[k].level_from_world[i];
      term.Q += R.transpose() * W * R;
      term.S += W * R;
      term.W += W;
    }
  }

  // R_i g - d_k of an image along the way of its carrier, where slopes are, and across it; all is
  // along it where the carrier stands.
  struct Leaning {
    Eigen::Matrix3d along_way = Eigen::Matrix3d::Identity();  // in the camera: what of a vector is
    double along = 0.0;
    double across = 0.0;
  };
  [[nodiscard]] Leaning LeaningOf(size_t k, size_t i) const {
    const Eigen::Matrix3d& R = drives_[k].level_from_world[i];
    const Eigen::Vector3d error = R * down_ - in_mount_[k];
    const Eigen::Vector3d way = R * drives_[k].travel[i];
    if (way.isZero(0.0)) return {.along = error.norm()};
    return {.along_way = way * way.transpose(),
            .along = error.dot(way),
            .across = error.dot(in_mount_[k].cross(way).normalized())};
  }

  // Cauchy's weights of the mounts: one that leans more than most pulls less than those that do
  // not, and attitudes that turn outweigh it.
  void Forgive() {
    for (size_t k = 0; k < drives_.size(); ++k) {
      const double lean = (in_mount_[k] - Eigen::Vector3d::UnitY()).norm();
      terms_[k].u = 1.0 / (std::pow(MountSigma_rad(drives_[k]), 2) + lean * lean);
    }
  }

  const std::vector<DriveAttitudes>& drives_;
  bool on_hills_;
  Eigen::Vector3d down_;
  std::vector<DriveTerm> terms_{};
  std::vector<Eigen::Vector3d> in_mount_{};
};

// What leans with turns is a mount on flat ground or hills under an upright one. Where it may be
// either, the sigma has half of what lies between.
Gravity Choose(const Estimate& flat, const Estimate& hilly) {
  const double left = flat.Alike_rad() / hilly.Alike_rad();
  Gravity gravity = left < kExplainedShare ? flat.Found() : hilly.Found();
  if (!(left < kEitherShare)) return gravity;
  const double apart_rad = AngleBetween(flat.Down(), hilly.Down());
  gravity.sigma_rad = std::hypot(gravity.sigma_rad, 0.5 * apart_rad);
  for (auto& [drive, sigma_rad] : gravity.mount_sigma_rad)
    sigma_rad = std::hypot(sigma_rad, 0.5 * apart_rad);
  return gravity;
}

}  // namespace

std::optional<Gravity> EstimateGravity(const Reconstruction& reconstruction,
                                       const ImageManifest& manifest) {
  const std::vector<DriveAttitudes> drives = AttitudesOfDrives(reconstruction, manifest);
  Reconstruction level;
  uint32_t next = 0;
  for (const DriveAttitudes& drive : drives) {
    for (const Eigen::Matrix3d& R : drive.level_from_world)
      level.images[ImageId(next++)].cam_from_world.rotation = Eigen::Quaterniond(R);
  }
  const std::optional<Eigen::Vector3d> start = FindGravity(level);
  if (!start) return std::nullopt;
  Estimate flat(drives, *start, false);
  Estimate hilly(drives, *start, true);
  flat.Run();
  hilly.Run();
  return Choose(flat, hilly);
}

}  // namespace orbweave
