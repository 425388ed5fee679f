// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/reduced_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/bundle/observation_term.h"

namespace orbweave {
namespace {

using Matrix63 = Eigen::Matrix<double, 6, 3>;

// A point's observation by a pose that moves.
struct SeenBy {
  uint32_t local;
  Eigen::Matrix3d M;  // J_X^T J_X
  Eigen::Vector3d d;
};

// A pose's part in the elimination of one point.
struct PosePart {
  uint32_t local;
  Matrix63 Y;  // W G with W = J_pose^T J_X = [[d]x; -I] M
};

// [d]x A
Eigen::Matrix3d CrossColumns(const Eigen::Vector3d& d, const Eigen::Matrix3d& A) {
  Eigen::Matrix3d result;
  for (int j = 0; j < 3; ++j) result.col(j) = d.cross(A.col(j));
  return result;
}

// J_pose^T J_pose = [[d]x; -I] M [[d]x; -I]^T
// and the traces of its two diagonal blocks.
void AddPoseHessian(const Eigen::Vector3d& d,
                    const Eigen::Matrix3d& M,
                    Block6& target,
                    Eigen::Vector2d& trace) {
  const Eigen::Matrix3d dM = CrossColumns(d, M);
  const Eigen::Matrix3d dMd = CrossColumns(d, dM.transpose());
  trace += Eigen::Vector2d(dMd.trace(), M.trace());
  target.topLeftCorner<3, 3>() += dMd;
  target.topRightCorner<3, 3>() -= dM;
  target.bottomLeftCorner<3, 3>() -= dM.transpose();
  target.bottomRightCorner<3, 3>() += M;
}

Vector6 PoseGradient(const Eigen::Vector3d& d, const Eigen::Vector3d& point_gradient) {
  Vector6 gradient;
  gradient << d.cross(point_gradient), -point_gradient;
  return gradient;
}

// target -= A B^T
void SubtractProduct(const Matrix63& A, const Matrix63& B, Block6& target) {
  for (int c = 0; c < 6; ++c) {
    target.col(c) -= A.col(0) * B(c, 0) + A.col(1) * B(c, 1) + A.col(2) * B(c, 2);
  }
}

// Upper triangle of G with G G^T = A^-1; zero when A is not positive definite.
std::array<double, 6> InverseFactor(const Eigen::Matrix3d& A) {
  const double l00 = std::sqrt(A(0, 0));
  const double l10 = A(1, 0) / l00;
  const double l20 = A(2, 0) / l00;
  const double p1 = A(1, 1) - l10 * l10;
  const double l11 = std::sqrt(p1);
  const double l21 = (A(2, 1) - l20 * l10) / l11;
  const double p2 = A(2, 2) - l20 * l20 - l21 * l21;
  const double l22 = std::sqrt(p2);
  const bool is_definite = A(0, 0) > 0.0 && p1 > 0.0 && p2 > 0.0;
  if (!is_definite || !std::isfinite(l22)) return {};
  const double g00 = 1.0 / l00;
  const double g11 = 1.0 / l11;
  const double g22 = 1.0 / l22;
  return {g00, -l10 * g00 * g11, g11, (l10 * l21 * g11 - l20) * g00 * g22, -l21 * g11 * g22, g22};
}

// Linearises and eliminates the points of one chunk.
class ChunkReducer {
 public:
  ChunkReducer(const BundleLayout& layout,
               const BundleState& state,
               const RobustLoss& loss,
               double lambda,
               ChunkSums& sums)
      : layout_(layout), state_(state), loss_(loss), lambda_(lambda), sums_(sums) {}

  PointFactor Reduce(const PackedPoint& point) {
    PointFactor factor;
    Eigen::Matrix3d V = Eigen::Matrix3d::Zero();
    seen_by_.clear();
    for (uint32_t k = point.first; k < point.end; ++k) {
      AddObservation(layout_.observations[k], state_.points[point.point], V, factor.gradient);
    }
    if (point.is_fixed) return factor;
    // A seen point has trace(V) > 0; without damping its depth would be undefined when seen once.
    factor.mu = lambda_ * V.trace() / 3.0;
    V.diagonal().array() += factor.mu;
    factor.upper = InverseFactor(V);
    Eliminate(factor);
    return factor;
  }

 private:
  void AddObservation(const PackedObservation& seen,
                      const Eigen::Vector3d& point_in_world,
                      Eigen::Matrix3d& V,
                      Eigen::Vector3d& point_gradient) {
    const PoseState& pose = state_.poses[seen.pose];
    const ObservationTerm term =
        LineariseObservation(layout_.residual, seen, pose, point_in_world, loss_);
    const Eigen::Matrix3d& M = term.hessian;
    V += M;
    point_gradient += term.gradient;
    if (seen.local == kHeld) return;
    AddPoseHessian(
        term.d, M, sums_.triangle[PairIndex(seen.local, seen.local)], sums_.trace[seen.local]);
    sums_.gradient[seen.local] += PoseGradient(term.d, term.gradient);
    seen_by_.push_back({seen.local, M, term.d});
  }

  void Eliminate(const PointFactor& factor) {
    const Eigen::Matrix3d G = factor.G();
    const Eigen::Vector3d h = G.transpose() * factor.gradient;
    if (parts_.size() < seen_by_.size()) parts_.resize(seen_by_.size());
    size_t count = 0;  // observations by the same pose become one part
    for (const SeenBy& seen : seen_by_) {
      const Eigen::Matrix3d MG = seen.M * G;
      Matrix63 Y;
      Y << CrossColumns(seen.d, MG), -MG;
      if (count > 0 && parts_[count - 1].local == seen.local) {
        parts_[count - 1].Y += Y;
      } else {
        parts_[count++] = {seen.local, Y};
      }
    }
    for (size_t j = 0; j < count; ++j) {
      sums_.rhs[parts_[j].local].noalias() += parts_[j].Y * h;
      for (size_t i = 0; i <= j; ++i) {
        SubtractProduct(
            parts_[i].Y, parts_[j].Y, sums_.triangle[PairIndex(parts_[i].local, parts_[j].local)]);
      }
    }
  }

  const BundleLayout& layout_;
  const BundleState& state_;
  const RobustLoss& loss_;
  double lambda_;
  ChunkSums& sums_;
  std::vector<SeenBy> seen_by_{};
  std::vector<PosePart> parts_{};
};

void ResetSums(size_t num_blocks, size_t num_pairs, ChunkSums& sums) {
  sums.triangle.assign(num_pairs, Block6::Zero());
  sums.rhs.assign(num_blocks, Vector6::Zero());
  sums.gradient.assign(num_blocks, Vector6::Zero());
  sums.trace.assign(num_blocks, Eigen::Vector2d::Zero());
}

}  // namespace

ReducedSystem MakeReducedSystem(const BundleLayout& layout) {
  SymmetricBlockMatrix S = layout.matrix;
  S.values.assign(S.rows.size(), Block6::Zero());
  ReducedSystem system{MakeNormalSystem(std::move(S))};
  system.points.resize(layout.points.size());
  return system;
}

void Clear(ReducedSystem& system) {
  system.S.SetZero();
  std::fill(system.rhs.begin(), system.rhs.end(), Vector6::Zero());
  std::fill(system.gradient.begin(), system.gradient.end(), Vector6::Zero());
  std::fill(system.trace.begin(), system.trace.end(), Eigen::Vector2d::Zero());
}

BearingReducer::BearingReducer(const BundleLayout& layout, int num_threads)
    : layout_(layout), num_threads_(num_threads), sums_(num_threads > 1 ? 16 * num_threads : 1) {}

void BearingReducer::AddBearings(const BundleState& state,
                                 const RobustLoss& loss,
                                 double lambda,
                                 ReducedSystem& system) {
  for (size_t first = 0; first < layout_.chunks.size(); first += sums_.size()) {
    const size_t count = std::min(sums_.size(), layout_.chunks.size() - first);
    ParallelFor(count, num_threads_, [&](size_t i) {
      const PointChunk& chunk = layout_.chunks[first + i];
      ResetSums(chunk.blocks.size(), chunk.NumPairs(), sums_[i]);
      ChunkReducer reducer(layout_, state, loss, lambda, sums_[i]);
      for (uint32_t p = chunk.first_point; p < chunk.end_point; ++p) {
        system.points[p] = reducer.Reduce(layout_.points[p]);
      }
    });
    for (size_t i = 0; i < count; ++i) Merge(layout_.chunks[first + i], sums_[i], system);
  }
}

void BearingReducer::Merge(const PointChunk& chunk,
                           const ChunkSums& sums,
                           ReducedSystem& system) const {
  for (const PointChunk::Target& target : chunk.targets) {
    system.S.values[target.value] += sums.triangle[target.pair];
  }
  for (size_t i = 0; i < chunk.blocks.size(); ++i) {
    system.rhs[chunk.blocks[i]] += sums.rhs[i] - sums.gradient[i];
    system.gradient[chunk.blocks[i]] += sums.gradient[i];
    system.trace[chunk.blocks[i]] += sums.trace[i];
  }
}

}  // namespace orbweave
