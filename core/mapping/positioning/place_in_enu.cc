// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_in_enu.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/mapping/positioning/position_agreement.h"
#include "core/mapping/positioning/turn_to_enu.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kStepShare = 0.1;
constexpr double kMostOfMedian = 10.0;
constexpr double kMinAgreeing = 0.7;

/// Turned, and with weights that compare with those of positions.
void TurnToEnu(const Eigen::Quaterniond& enu_from_world, DifferenceGraph& displacements) {
  displacements.differences *= enu_from_world.conjugate().toRotationMatrix();
  const Eigen::VectorXd squares = displacements.differences.rowwise().squaredNorm();
  Eigen::VectorXd exactness = displacements.weights.cwiseProduct(squares);
  exactness /= UpperMedian({exactness.data(), exactness.data() + exactness.size()});
  displacements.weights = exactness.cwiseMax(1.0 / kMostOfMedian)
                              .cwiseMin(kMostOfMedian)
                              .cwiseQuotient(kStepShare * kStepShare * squares);
}

/// The displacements in some columns, and the positions there as displacements from nodes more: one
/// origin, or one for each drive.
DifferenceGraph WithPositions(const ClusterProblem& problem,
                              std::span<const ImageSlot> images,
                              const DifferenceGraph& displacements,
                              double scatter,
                              Eigen::Index first,
                              Eigen::Index columns,
                              std::span<const uint32_t> origins) {
  DifferenceGraph graph{.num_nodes = *std::ranges::max_element(origins) + 1,
                        .edges = displacements.edges};
  const auto most = displacements.differences.rows() + static_cast<Eigen::Index>(images.size());
  graph.differences.resize(most, columns);
  graph.weights.resize(most);
  Eigen::Index row = displacements.differences.rows();
  graph.differences.topRows(row) = displacements.differences.middleCols(first, columns);
  graph.weights.head(row) = displacements.weights;
  for (const ImageSlot image : images) {
    const PosePrior& prior = problem.images[image].prior;
    if (!prior.position_in_enu) continue;
    const double sigma_m =
        scatter * (first == 0 ? prior.horizontal_sigma_m : prior.vertical_sigma_m);
    graph.edges.push_back({origins[image], image});
    graph.differences.row(row) = prior.position_in_enu->segment(first, columns).transpose();
    graph.weights[row++] = 1.0 / (sigma_m * sigma_m);
  }
  graph.differences.conservativeResize(row, columns);
  graph.weights.conservativeResize(row);
  return graph;
}

/// Nodes beyond those of the images, by the drive of each.
std::vector<uint32_t> OriginOfDrive(const ClusterProblem& problem) {
  std::map<uint32_t, uint32_t> origin_of_drive;
  const auto num_images = static_cast<uint32_t>(problem.images.size());
  std::vector<uint32_t> origins;
  for (const ClusterImage& image : problem.images) {
    const auto next = num_images + static_cast<uint32_t>(origin_of_drive.size());
    origins.push_back(origin_of_drive.try_emplace(image.drive, next).first->second);
  }
  return origins;
}

/// Sets the centres and the offsets of heights.
absl::Status PlaceCentres(const ClusterProblem& problem,
                          std::span<const ImageSlot> images,
                          const DifferenceGraph& displacements,
                          const StageContext& context,
                          EnuPlacement& placed) {
  const auto num_images = static_cast<Eigen::Index>(displacements.num_nodes);
  const std::vector<uint32_t> one_origin(problem.images.size(), displacements.num_nodes);
  ORBWEAVE_ASSIGN_OR_RETURN(
      const AveragedDifferences plan,
      AverageDifferences(
          WithPositions(problem, images, displacements, placed.scatter, 0, 2, one_origin),
          context));
  const std::vector<uint32_t> origins = OriginOfDrive(problem);
  ORBWEAVE_ASSIGN_OR_RETURN(
      const AveragedDifferences heights,
      AverageDifferences(
          WithPositions(problem, images, displacements, placed.scatter, 2, 1, origins), context));
  const Eigen::RowVectorXd zero = plan.values.row(num_images);
  const double zero_height = heights.values(origins[images.front()], 0);
  placed.centres.resize(num_images, 3);
  placed.centres.leftCols(2) = plan.values.topRows(num_images).rowwise() - zero;
  placed.centres.col(2) = heights.values.col(0).head(num_images).array() - zero_height;
  placed.height_offset_m.clear();
  for (const uint32_t origin : origins)
    placed.height_offset_m.push_back(zero_height - heights.values(origin, 0));
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::optional<EnuPlacement>> PlaceInEnu(
    const ClusterProblem& problem,
    std::span<const ImageSlot> images,
    std::span<const Eigen::Quaterniond> cams_from_world,
    DifferenceGraph displacements,
    double least_scatter,
    const StageContext& context) {
  if (displacements.edges.empty() || !DoPositionsSpread(problem, images, 1.0))
    return std::optional<EnuPlacement>();
  EnuPlacement placed{.enu_from_world =
                          EnuFromDisplacements(problem, images, cams_from_world, displacements)};
  TurnToEnu(placed.enu_from_world, displacements);
  ORBWEAVE_RETURN_IF_ERROR(PlaceCentres(problem, images, displacements, context, placed));
  const auto centre_of = [&](ImageSlot image) -> Vector3d { return placed.centres.row(image); };
  placed.scatter = std::max(least_scatter, ScatterAbout(problem, images, centre_of));
  if (!DoPositionsSpread(problem, images, placed.scatter)) return std::optional<EnuPlacement>();
  if (placed.scatter > 1.0)
    ORBWEAVE_RETURN_IF_ERROR(PlaceCentres(problem, images, displacements, context, placed));
  if (ShareOnPositions(problem, images, placed.scatter, centre_of) < kMinAgreeing)
    return std::optional<EnuPlacement>();
  return placed;
}

}  // namespace orbweave
