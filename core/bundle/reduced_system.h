// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/bundle/block_matrix.h"
#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/normal_system.h"
#include "core/bundle/robust_loss.h"

namespace orbweave {

/// Of a point's 3x3 Hessian V with damping: V + mu I = (G G^T)^-1, G upper triangular.
struct PointFactor {
  std::array<double, 6> upper{};  ///< of G, by columns; zero: the point is held in this step
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double mu = 0.0;

  [[nodiscard]] Eigen::Matrix3d G() const {
    Eigen::Matrix3d G;
    G << upper[0], upper[1], upper[3], 0.0, upper[2], upper[4], 0.0, 0.0, upper[5];
    return G;
  }
};

/// Normal equations of all poses and biases after the points are eliminated:
///   S = U + mu I - sum W (V + mu I)^-1 W^T,   rhs = -(g - sum W (V + mu I)^-1 g_point).
/// mu is as of DampPoses. That is what is left of
///
///     [ U    W ] [ step       ]     [ g       ]     U: poses and biases
///     [ W^T  V ] [ point step ] = - [ g_point ]     V: a 3x3 block per point, nothing beside it
///
/// and S, the reduced camera matrix, has a block wherever a point is seen by two poses: on a street
/// a band, and a border for what all of it shares. Poses A to E, of which each shares points with
/// the next two, b the bias of their drive, p a retained point that C and D see; stored are the
/// blocks x of the upper triangle:
///
///           A B C D E b p
///       A [ x x x     x   ]
///       B [   x x x   x   ]
///       C [     x x x x x ]
///       D [       x x x x ]
///       E [         x x   ]
///       b [           x   ]
///       p [             x ]
struct ReducedSystem : NormalSystem {
  std::vector<PointFactor> points{};  ///< per layout.points
};

/// Workspace for systems of `layout`'s structure.
[[nodiscard]] ReducedSystem MakeReducedSystem(const BundleLayout& layout);

/// Everything but the structure to zero.
void Clear(ReducedSystem& system);

/// Sums of one chunk, in its own dense triangle.
struct ChunkSums {
  std::vector<Block6> triangle{};
  std::vector<Vector6> rhs{};
  std::vector<Vector6> gradient{};
  std::vector<Eigen::Vector2d> trace{};
};

/// Forms the reduced system of bearings chunk by chunk on `num_threads` threads and adds the chunks
/// in order. `system` is cleared by the caller,
/// who also adds priors and damps the poses.
class BearingReducer {
 public:
  BearingReducer(const BundleLayout& layout, int num_threads);

  void AddBearings(const BundleState& state,
                   const RobustLoss& loss,
                   double lambda,
                   ReducedSystem& system);

 private:
  void Merge(const PointChunk& chunk, const ChunkSums& sums, ReducedSystem& system) const;

  const BundleLayout& layout_;
  int num_threads_ = 1;
  std::vector<ChunkSums> sums_{};  // one per chunk of a wave
};

}  // namespace orbweave
