// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/mapping/positioning/sights.h"

namespace orbweave {

/// Centres of images by their positions and by sights: the minimum of PlaceByPositions. Three
/// unknowns per image, and the height of an origin per drive. Begun on the positions themselves;
/// from round to round sights are held more exactly, and in the first ten positions that are not
/// trusted (SightsBesidePositions) say nothing.
class PositionSystem {
 public:
  /// `images`: those that sights join. `problem` and `images` must outlive this. One image at least
  /// has a position.
  PositionSystem(const ClusterProblem& problem,
                 std::span<const ImageSlot> images,
                 const std::vector<Sight>& sights);

  /// Goes on from where images stand. `scatter`: what sigmas of positions are multiplied with.
  /// False when the system has no solution.
  [[nodiscard]] bool Solve(double scatter);

  /// Heights are over the origin of the first drive.
  [[nodiscard]] Eigen::Vector3d Centre(ImageSlot image) const {
    return At(row_[image]) + heights_[0] * Eigen::Vector3d::UnitZ();
  }
  /// By how much positions of a drive are higher.
  [[nodiscard]] double HeightOffset(uint32_t drive) const;

 private:
  [[nodiscard]] Eigen::Index NumImages() const { return static_cast<Eigen::Index>(images_.size()); }
  [[nodiscard]] Eigen::Vector3d At(int row) const { return centres_.row(row).transpose(); }
  [[nodiscard]] bool IsTrusted(ImageSlot image) const {
    return is_trusted_[static_cast<size_t>(row_[image])] != 0;
  }
  void StandOnPositions();
  void AddPositions(double scatter, int round);
  void AddPlan(int row, const Eigen::Vector3d& position, double sigma_m);
  void AddHeight(int row, int origin, double height_m, double sigma_m);
  void AddSight(const Sight& sight, double slack_m);
  void AddStep(int a, int b, const Eigen::Matrix3d& information, const Eigen::Vector3d& value);
  [[nodiscard]] bool SolveOnce(double scatter, int round);

  const ClusterProblem& problem_;
  std::span<const ImageSlot> images_;
  std::vector<int> row_;               ///< of each image of the cluster; -1: not among them
  std::map<uint32_t, int> origins_{};  ///< of each drive
  std::vector<Sight> sights_{};
  std::vector<uint8_t> is_trusted_{};  ///< per row
  double usual_sigma_m_ = 1.0;         ///< of positions, horizontally
  Eigen::MatrixXd centres_{};
  Eigen::VectorXd heights_{};
  std::vector<Eigen::Triplet<double>> left_{};
  Eigen::VectorXd right_{};
};

}  // namespace orbweave
