// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/position_system.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/quantile.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDirectionSigmaRad = std::numbers::pi / 180.0;
constexpr double kLeastSigma_m = 0.1;
constexpr GemanMcClureLoss kLoss(3.0);
constexpr int kFirstRounds = 10;
constexpr int kReweightings = 30;
constexpr double kTightening = 0.8;
/// Origins of drives are somewhere.
constexpr double kOriginWeight = 1e-6;

}  // namespace

PositionSystem::PositionSystem(const ClusterProblem& problem,
                               std::span<const ImageSlot> images,
                               const std::vector<Sight>& sights)
    : problem_(problem), images_(images), row_(problem.images.size(), -1) {
  std::vector<double> sigmas;
  for (size_t i = 0; i < images.size(); ++i) {
    const ClusterImage& image = problem.images[images[i]];
    row_[images[i]] = static_cast<int>(i);
    origins_.try_emplace(image.drive, static_cast<int>(origins_.size()));
    if (image.prior.position_in_enu) sigmas.push_back(image.prior.horizontal_sigma_m);
  }
  usual_sigma_m_ = Quantile(sigmas, 0.5);
  const SightsBesidePositions beside(problem, sights);
  for (const Sight& sight : sights) {
    if (row_[sight.a] >= 0 && beside.Fits(sight)) sights_.push_back(sight);
  }
  GuessLengthsOfSteps(
      problem, [&](ImageSlot image) { return beside.IsTrusted(image); }, sights_);
  for (const ImageSlot image : images) is_trusted_.push_back(beside.IsTrusted(image) ? 1 : 0);
  heights_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(origins_.size()));
  StandOnPositions();
}

bool PositionSystem::Solve(double scatter) {
  for (int round = 0; round <= kReweightings; ++round) {
    if (!SolveOnce(scatter, round)) return false;
  }
  return true;
}

double PositionSystem::HeightOffset(uint32_t drive) const {
  const auto origin = origins_.find(drive);
  return origin == origins_.end() ? 0.0 : heights_[origin->second] - heights_[0];
}

/// To begin with; where there is none that is trusted, on that of the strongest sight.
void PositionSystem::StandOnPositions() {
  centres_ = Eigen::MatrixXd::Zero(NumImages(), 3);
  std::vector<uint32_t> strength(images_.size(), 0);
  const auto stand = [&](ImageSlot image, ImageSlot on, uint32_t num_inliers) {
    const auto row = static_cast<size_t>(row_[image]);
    const std::optional<Vector3d>& position = problem_.images[on].prior.position_in_enu;
    if (!position || !IsTrusted(on) || num_inliers <= strength[row]) return;
    strength[row] = num_inliers;
    centres_.row(row_[image]) = position->transpose();
  };
  for (const Sight& sight : sights_) {
    stand(sight.a, sight.b, sight.num_inliers);
    stand(sight.b, sight.a, sight.num_inliers);
  }
  for (const ImageSlot image : images_) stand(image, image, std::numeric_limits<uint32_t>::max());
}

void PositionSystem::AddPositions(double scatter, int round) {
  for (int row = 0; row < NumImages(); ++row) {
    const ClusterImage& image = problem_.images[images_[static_cast<size_t>(row)]];
    const bool is_heard = round >= kFirstRounds || is_trusted_[static_cast<size_t>(row)] != 0;
    if (!image.prior.position_in_enu || !is_heard) continue;
    const Vector3d& position = *image.prior.position_in_enu;
    AddPlan(row, position, scatter * image.prior.horizontal_sigma_m);
    AddHeight(row, origins_.at(image.drive), position.z(), scatter * image.prior.vertical_sigma_m);
  }
}

void PositionSystem::AddPlan(int row, const Vector3d& position, double sigma_m) {
  const double squared = (At(row) - position).head<2>().squaredNorm() / (sigma_m * sigma_m);
  const double weight = kLoss.Weight(squared) / (sigma_m * sigma_m);
  for (const int axis : {0, 1}) {
    left_.emplace_back(3 * row + axis, 3 * row + axis, weight);
    right_[3 * row + axis] += weight * position[axis];
  }
}

void PositionSystem::AddHeight(int row, int origin, double height_m, double sigma_m) {
  const double error = (centres_(row, 2) + heights_[origin] - height_m) / sigma_m;
  const double weight = kLoss.Weight(error * error) / (sigma_m * sigma_m);
  const int places[] = {3 * row + 2, static_cast<int>(3 * NumImages()) + origin};
  for (const int i : places) {
    right_[i] += weight * height_m;
    for (const int j : places) left_.emplace_back(i, j, weight);
  }
}

/// `slack_m`: of where images stand so far.
void PositionSystem::AddSight(const Sight& sight, double slack_m) {
  const int a = row_[sight.a];
  const int b = row_[sight.b];
  const Vector3d step = At(b) - At(a);
  const double along_m = step.dot(sight.direction);
  // What leads backwards is wrong.
  if (along_m < -slack_m) return;
  const Matrix3d along = sight.direction * sight.direction.transpose();
  const double sigma_m = std::hypot(kLeastSigma_m, kDirectionSigmaRad * step.norm(), slack_m);
  const double across = (step - along_m * sight.direction).squaredNorm() / (sigma_m * sigma_m);
  const double weight = sight.weight * kLoss.Weight(across);
  Matrix3d information = weight / (sigma_m * sigma_m) * (Matrix3d::Identity() - along);
  Vector3d value = Vector3d::Zero();
  if (sight.length_m > 0.0) {
    const double length_sigma_m = std::hypot(kStepShare * sight.length_m, slack_m);
    const double error = (along_m - sight.length_m) / length_sigma_m;
    const double length_weight = weight * kLoss.Weight(error * error);
    information += length_weight / (length_sigma_m * length_sigma_m) * along;
    value = sight.length_m * sight.direction;
  }
  AddStep(a, b, information, value);
}

/// (x_b - x_a - value)^T information (x_b - x_a - value).
void PositionSystem::AddStep(int a, int b, const Matrix3d& information, const Vector3d& value) {
  right_.segment<3>(3 * b) += information * value;
  right_.segment<3>(3 * a) -= information * value;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      left_.emplace_back(3 * a + r, 3 * a + c, information(r, c));
      left_.emplace_back(3 * b + r, 3 * b + c, information(r, c));
      left_.emplace_back(3 * a + r, 3 * b + c, -information(r, c));
      left_.emplace_back(3 * b + r, 3 * a + c, -information(r, c));
    }
  }
}

bool PositionSystem::SolveOnce(double scatter, int round) {
  const Eigen::Index size = 3 * NumImages() + heights_.size();
  left_.clear();
  right_ = Eigen::VectorXd::Zero(size);
  AddPositions(scatter, round);
  const double slack_m = std::pow(kTightening, round) * kLeastScatter * scatter * usual_sigma_m_;
  for (const Sight& sight : sights_) AddSight(sight, slack_m);
  // Heights of all drives and all images may change together, and what is in no term at all.
  for (int i = 0; i < size; ++i) left_.emplace_back(i, i, kOriginWeight);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(left_.begin(), left_.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt(matrix);
  if (ldlt.info() != Eigen::Success) return false;
  const Eigen::VectorXd solution = ldlt.solve(right_);
  if (!solution.allFinite()) return false;
  for (Eigen::Index i = 0; i < NumImages(); ++i)
    centres_.row(i) = solution.segment<3>(3 * i).transpose();
  heights_ = solution.tail(heights_.size());
  return true;
}

}  // namespace orbweave
