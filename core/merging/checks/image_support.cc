// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/image_support.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/bundle/bearing_term.h"
#include "core/geometry/sphere_cells.h"
#include "core/merging/checks/pose_from_point.h"

namespace orbweave {
namespace {

constexpr double kUnknowns = 6.0;
constexpr double kMaxSigma_rad = 0.1 / 3.0;
// A patch enters the test of coherence by what it says beyond this share of the whole: below, its
// gradient is rounding.
constexpr double kNoticeable = 1e-3;

using Patches = std::map<std::pair<ImageId, uint32_t>, PatchSupport>;

/// One track at the adjusted poses.
class TrackTerms {
 public:
  TrackTerms(const Track& track, const Reconstruction& scene) : track_(track) {
    for (const Observation& seen : track.observations) {
      const Rigid3& pose = scene.images.at(seen.ref.image).cam_from_world;
      const double weight = 1.0 / (seen.sigma_rad * seen.sigma_rad);
      terms_.push_back(LineariseBearing(
          pose.Centre(), track.point_in_world, pose.rotation.conjugate() * seen.bearing));
      hessians_.push_back(PointHessian(terms_.back(), weight));
      gradients_.push_back(PointGradient(terms_.back(), weight));
      hessian_ += hessians_.back();
      gradient_ += gradients_.back();
    }
  }

  void AddTo(Patches& patches) const {
    const Eigen::LDLT<Eigen::Matrix3d> whole(hessian_);
    if (whole.info() != Eigen::Success || !whole.isPositive()) return;
    const auto count = static_cast<double>(terms_.size());
    for (size_t i = 0; i < terms_.size(); ++i) {
      const Observation& seen = track_.observations[i];
      const uint32_t patch = SphereCell(seen.bearing, kSupportBands);
      const Eigen::Matrix3d held = hessians_[i] - hessians_[i] * whole.solve(hessians_[i]);
      const Eigen::Vector3d pull = gradients_[i] - hessians_[i] * whole.solve(gradient_);
      if (!held.allFinite() || !pull.allFinite()) continue;
      const Eigen::Matrix<double, 6, 3> A = PoseFromPoint(terms_[i].d);
      PatchSupport& support = patches[{seen.ref.image, patch}];
      support.image = seen.ref.image;
      support.patch = patch;
      support.hessian += A * held * A.transpose();
      support.gradient += A * pull;
      ++support.observations;
      support.equations += terms_.size() > 2 ? 2 : 1;
      support.sum_of_squares += terms_[i].squared_angle / (seen.sigma_rad * seen.sigma_rad);
      support.redundancy += 2.0 - 3.0 / count;
    }
  }

 private:
  const Track& track_;
  std::vector<BearingTerm> terms_;
  std::vector<Eigen::Matrix3d> hessians_;
  std::vector<Eigen::Vector3d> gradients_;
  Eigen::Matrix3d hessian_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient_ = Eigen::Vector3d::Zero();
};

PatchSupport SumOf(std::span<const PatchSupport> patches) {
  PatchSupport sum;
  for (const PatchSupport& patch : patches) {
    sum.observations += patch.observations;
    sum.equations += patch.equations;
    sum.hessian += patch.hessian;
    sum.sum_of_squares += patch.sum_of_squares;
    sum.redundancy += patch.redundancy;
  }
  return sum;
}

/// Makes positions angles: divides them by the typical depth, sqrt(trace by rotation / trace by
/// position).
Vector6 UnitsOf(const Block6& hessian) {
  const double turns = hessian.topLeftCorner<3, 3>().trace();
  const double shifts = hessian.bottomRightCorner<3, 3>().trace();
  const double depth = shifts > 0.0 && turns > 0.0 ? std::sqrt(turns / shifts) : 1.0;
  Vector6 units = Vector6::Ones();
  units.tail<3>().setConstant(depth);
  return units;
}

Block6 InUnits(const Block6& hessian, const Vector6& units) {
  return units.asDiagonal() * hessian * units.asDiagonal();
}

/// Standard deviation of the worst known combination of the unknowns; infinity where one is free.
double WorstSigma(const Block6& hessian, double scatter) {
  const Eigen::SelfAdjointEigenSolver<Block6> solver(hessian, Eigen::EigenvaluesOnly);
  const Vector6& values = solver.eigenvalues();
  if (solver.info() != Eigen::Success || !(values[0] > 1e-12 * values[5]))
    return std::numeric_limits<double>::infinity();
  return std::sqrt(scatter / values[0]);
}

/// Sum of g^T H^-1 g over patches, and how many directions it is over.
double CoherenceOf(std::span<const PatchSupport> patches, const Block6& whole, double scatter) {
  const Vector6 units = UnitsOf(whole);
  const double noticeable = kNoticeable * InUnits(whole, units).trace() / kUnknowns;
  double squares = 0.0;
  double freedoms = -kUnknowns;
  for (const PatchSupport& patch : patches) {
    const Eigen::SelfAdjointEigenSolver<Block6> solver(InUnits(patch.hessian, units));
    if (solver.info() != Eigen::Success) continue;
    const Vector6 pulls = solver.eigenvectors().transpose() * (units.asDiagonal() * patch.gradient);
    for (int k = 0; k < 6; ++k) {
      if (!(solver.eigenvalues()[k] > noticeable)) continue;
      squares += pulls[k] * pulls[k] / solver.eigenvalues()[k];
      freedoms += 1.0;
    }
  }
  if (freedoms < kUnknowns) return 1.0;
  return squares / (scatter * freedoms);
}

Track LeftOf(Track track, const std::set<ImageId>& without) {
  std::erase_if(track.observations,
                [&](const Observation& seen) { return without.contains(seen.ref.image); });
  return track;
}

std::string Number(double value) { return std::to_string(std::lround(value)); }

}  // namespace

std::vector<PatchSupport> SupportOf(const Subproblem& subproblem,
                                    const std::set<ImageId>& without) {
  Patches patches;
  const auto add = [&](const Track& track) {
    if (track.observations.size() > 1) TrackTerms(track, subproblem.scene).AddTo(patches);
  };
  const auto add_left = [&](const Track& track) {
    if (without.empty()) {
      add(track);
    } else {
      add(LeftOf(track, without));
    }
  };
  for (const Track& track : subproblem.scene.tracks) add_left(track);
  for (const SplitTrack& track : subproblem.split) add_left(track.part);
  std::vector<PatchSupport> sorted;
  for (auto& [key, support] : patches) sorted.push_back(support);
  return sorted;
}

void AddSupport(std::span<const PatchSupport> patches,
                std::map<ImageId, std::vector<PatchSupport>>& of_image) {
  for (const PatchSupport& patch : patches) {
    std::vector<PatchSupport>& known = of_image[patch.image];
    const auto same = std::ranges::find(known, patch.patch, &PatchSupport::patch);
    if (same == known.end()) {
      known.push_back(patch);
      continue;
    }
    same->observations += patch.observations;
    same->equations += patch.equations;
    same->hessian += patch.hessian;
    same->gradient += patch.gradient;
    same->sum_of_squares += patch.sum_of_squares;
    same->redundancy += patch.redundancy;
  }
}

SupportVerdict JudgeSupport(std::span<const PatchSupport> patches) {
  SupportVerdict verdict;
  const PatchSupport whole = SumOf(patches);
  if (whole.observations == 0)
    return {.is_weak = true, .reason = "it has no observations of points that other images hold"};
  const double redundancy = whole.redundancy - kUnknowns;
  if (redundancy >= 1.0) verdict.scatter = std::max(whole.sum_of_squares / redundancy, 1e-4);
  const Vector6 units = UnitsOf(whole.hessian);
  const Block6 all = InUnits(whole.hessian, units);
  const std::string seen =
      std::to_string(whole.observations) + " observations of points that " + "other images hold";
  if (WorstSigma(all, verdict.scatter) > kMaxSigma_rad) {
    verdict.is_weak = true;
    verdict.reason = "its " + seen + " do not fix its pose";
    return verdict;
  }
  for (const PatchSupport& patch : patches) {
    const double left = static_cast<double>(whole.equations) - patch.equations;
    const bool checks = left >= 2.0 * kUnknowns;
    const Block6 rest = InUnits(whole.hessian - patch.hessian, units);
    if (checks && WorstSigma(rest, verdict.scatter) <= kMaxSigma_rad) continue;
    verdict.is_weak = true;
    verdict.reason = "it has " + seen + ", " + std::to_string(patch.observations) +
                     " of them in one corner (" + Number(100.0 / (kSupportBands * kSupportBands)) +
                     " % of the sphere): the others " +
                     (checks ? "do not fix its pose" : "are too few to check its pose");
    return verdict;
  }
  verdict.coherence = CoherenceOf(patches, whole.hessian, verdict.scatter);
  return verdict;
}

}  // namespace orbweave
