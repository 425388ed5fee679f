// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/place_by_positions.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/quantile.h"
#include "core/graph/disjoint_sets.h"
#include "core/mapping/pair_directions.h"
#include "core/mapping/position_agreement.h"
#include "core/mapping/turn_to_enu.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Receivers promise too much between houses.
constexpr double kLeastScatter = 2.0;
constexpr double kMinAgreeing = 0.7;
constexpr double kDirectionSigmaRad = std::numbers::pi / 180.0;
constexpr double kLeastSigma_m = 0.1;
constexpr double kLengthShare = 0.3;
constexpr double kFarSquared = 9.0;
constexpr double kMaxSigmas = 3.0;
/// What a sight says of positions, beside a step.
constexpr double kFarSight = 0.25;
/// Rounds in which positions that are not trusted say nothing.
constexpr int kFirstRounds = 10;
constexpr int kReweightings = 30;
/// From round to round directions are held more exactly.
constexpr double kTightening = 0.8;
/// Origins of drives are somewhere.
constexpr double kOriginWeight = 1e-6;

/// The largest set of images that edges join, ascending.
std::vector<ImageSlot> JoinedImages(const PairDirections& pairs) {
  const auto num_images = static_cast<uint32_t>(pairs.cams_from_world.size());
  if (pairs.edges.empty()) return {};
  DisjointSets sets(num_images);
  for (const ViewEdge& edge : pairs.edges) sets.Unite(edge.pair.a.value, edge.pair.b.value);
  uint32_t largest = 0;
  for (uint32_t image = 0; image < num_images; ++image) {
    if (sets.SizeOf(image) > sets.SizeOf(largest)) largest = image;
  }
  std::vector<ImageSlot> images;
  for (uint32_t image = 0; image < num_images; ++image) {
    if (sets.Find(image) == sets.Find(largest)) images.push_back(image);
  }
  return images;
}

/// Directions as displacements that are as long as positions have them.
DifferenceGraph DirectionsAsLongAsPositions(const ClusterProblem& problem,
                                            const PairDirections& pairs) {
  DifferenceGraph steps{.num_nodes = static_cast<uint32_t>(pairs.cams_from_world.size())};
  const auto num_edges = static_cast<Eigen::Index>(pairs.edges.size());
  steps.differences.resize(num_edges, 3);
  steps.weights = Eigen::VectorXd::Ones(num_edges);
  Eigen::Index row = 0;
  for (size_t e = 0; e < pairs.edges.size(); ++e) {
    const uint32_t a = pairs.edges[e].pair.a.value;
    const uint32_t b = pairs.edges[e].pair.b.value;
    const PosePrior& of_a = problem.images[a].prior;
    const PosePrior& of_b = problem.images[b].prior;
    if (!of_a.position_in_enu || !of_b.position_in_enu) continue;
    const double length_m = (*of_b.position_in_enu - *of_a.position_in_enu).head<2>().norm();
    steps.edges.push_back({a, b});
    steps.differences.row(row++) = length_m * pairs.Direction(e).transpose();
  }
  steps.differences.conservativeResize(row, 3);
  steps.weights.conservativeResize(row);
  return steps;
}

double WeightOf(double error_squared) {
  const double root = 1.0 + error_squared / kFarSquared;
  return 1.0 / (root * root);
}

/// What a pair says of where its images stand, in east, north and up.
struct Sight {
  ImageSlot a = 0;
  ImageSlot b = 0;
  Vector3d direction = Vector3d::UnitX();  ///< unit, from a to b
  uint32_t num_inliers = 0;
  double length_m = 0.0;  ///< 0: nothing is known of it
  double weight = 1.0;
};

/// Horizontally; nullopt where a position is missing.
std::optional<Vector3d> StepBetweenPositions(const ClusterProblem& problem, const Sight& sight) {
  const PosePrior& a = problem.images[sight.a].prior;
  const PosePrior& b = problem.images[sight.b].prior;
  if (!a.position_in_enu || !b.position_in_enu) return std::nullopt;
  Vector3d step = *b.position_in_enu - *a.position_in_enu;
  step.z() = 0.0;  // drives may have origins of their own
  return step;
}

/// Sights of each image, as indices.
std::vector<std::vector<size_t>> SightsOfImages(size_t num_images,
                                                const std::vector<Sight>& sights) {
  std::vector<std::vector<size_t>> of_image(num_images);
  for (size_t s = 0; s < sights.size(); ++s) {
    of_image[sights[s].a].push_back(s);
    of_image[sights[s].b].push_back(s);
  }
  return of_image;
}

/// The sights of most inliers of each image, of all and of those that lead the other way: the next
/// images to either side. Ascending.
std::vector<size_t> FindSteps(const std::vector<Sight>& sights,
                              const std::vector<std::vector<size_t>>& of_image) {
  constexpr double kOtherWay = -0.5;
  std::vector<size_t> steps;
  for (ImageSlot image = 0; image < of_image.size(); ++image) {
    const auto away = [&](size_t s) -> Vector3d {
      return sights[s].a == image ? sights[s].direction : Vector3d(-sights[s].direction);
    };
    const auto append_strongest = [&](const auto& counts) {
      size_t strongest = sights.size();
      for (const size_t s : of_image[image]) {
        if (counts(s) &&
            (strongest == sights.size() || sights[s].num_inliers > sights[strongest].num_inliers))
          strongest = s;
      }
      if (strongest < sights.size()) steps.push_back(strongest);
    };
    if (of_image[image].empty()) continue;
    append_strongest([](size_t) { return true; });
    const Vector3d there = away(steps.back());
    append_strongest([&](size_t s) { return away(s).dot(there) < kOtherWay; });
  }
  std::ranges::sort(steps);
  const auto [from, to] = std::ranges::unique(steps);
  steps.erase(from, to);
  return steps;
}

/// Sights of places that look alike have few inliers beside those of steps.
void Weigh(std::span<const size_t> steps, std::vector<Sight>& sights) {
  std::vector<double> counts;
  for (const size_t s : steps) counts.push_back(sights[s].num_inliers);
  const double usual = Quantile(counts, 0.5);
  for (Sight& sight : sights) sight.weight = 2.0 * sight.num_inliers / (sight.num_inliers + usual);
}

/// Steps are taken to be as long as those around them are between positions that count, in the
/// median.
template <typename Counts>
void GuessLengthsOfSteps(const ClusterProblem& problem,
                         const Counts& counts,
                         std::vector<Sight>& sights) {
  const auto of_image = SightsOfImages(problem.images.size(), sights);
  const std::vector<size_t> steps = FindSteps(sights, of_image);
  if (steps.empty()) return;
  Weigh(steps, sights);
  std::vector<std::vector<double>> lengths_about(problem.images.size());
  for (const size_t s : steps) {
    const std::optional<Vector3d> step = StepBetweenPositions(problem, sights[s]);
    if (!step || !counts(sights[s].a) || !counts(sights[s].b)) continue;
    for (const ImageSlot end : {sights[s].a, sights[s].b}) {
      for (const size_t about : of_image[end]) {
        lengths_about[sights[about].a].push_back(step->norm());
        lengths_about[sights[about].b].push_back(step->norm());
      }
    }
  }
  for (Sight& sight : sights) sight.length_m = 0.0;
  for (const size_t s : steps) {
    std::vector<double> about = lengths_about[sights[s].a];
    const std::vector<double>& more = lengths_about[sights[s].b];
    about.insert(about.end(), more.begin(), more.end());
    if (!about.empty()) sights[s].length_m = Quantile(about, 0.5);
  }
}

/// Which sights lie as positions do, and which positions as most of their sights do.
class SightsBesidePositions {
 public:
  SightsBesidePositions(const ClusterProblem& problem, const std::vector<Sight>& sights)
      : problem_(problem), sights_(sights), is_trusted_(problem.images.size(), 0) {
    for (size_t i = 0; i < problem.images.size(); ++i)
      is_trusted_[i] = problem.images[i].prior.position_in_enu ? 1 : 0;
    while (DistrustTheWorst()) continue;
  }

  [[nodiscard]] bool IsTrusted(ImageSlot image) const { return is_trusted_[image] != 0; }
  /// Of two positions that are trusted, or of fewer.
  [[nodiscard]] bool Fits(const Sight& sight) const {
    return !IsTrusted(sight.a) || !IsTrusted(sight.b) || Agrees(sight);
  }

 private:
  [[nodiscard]] bool Agrees(const Sight& sight) const {
    const double sigma_m =
        kLeastScatter * std::hypot(problem_.images[sight.a].prior.horizontal_sigma_m,
                                   problem_.images[sight.b].prior.horizontal_sigma_m);
    const Vector3d step = *StepBetweenPositions(problem_, sight);
    const Vector3d level = Vector3d(sight.direction.x(), sight.direction.y(), 0.0).normalized();
    const double along_m = level.dot(step);
    if (along_m < -kMaxSigmas * sigma_m) return false;
    if ((step - along_m * level).norm() > kMaxSigmas * sigma_m) return false;
    return sight.length_m == 0.0 ||
           std::abs(along_m - sight.length_m) <=
               kMaxSigmas * std::hypot(sigma_m, kLengthShare * sight.length_m);
  }

  /// The position that the largest share of its sights contradicts, more than half. Steps count for
  /// more: hardly one of these is of a place that looks alike, and how long they are is known.
  bool DistrustTheWorst() {
    std::vector<double> all(is_trusted_.size(), 0.0);
    std::vector<double> against(is_trusted_.size(), 0.0);
    for (const Sight& sight : sights_) {
      if (!IsTrusted(sight.a) || !IsTrusted(sight.b)) continue;
      const double weight = (sight.length_m > 0.0 ? 1.0 : kFarSight) * sight.weight;
      for (const ImageSlot image : {sight.a, sight.b}) {
        all[image] += weight;
        if (!Agrees(sight)) against[image] += weight;
      }
    }
    size_t worst = 0;
    double worst_share = 0.5;
    for (size_t i = 0; i < all.size(); ++i) {
      if (against[i] <= worst_share * all[i]) continue;
      worst = i;
      worst_share = against[i] / all[i];
    }
    if (worst_share <= 0.5) return false;
    is_trusted_[worst] = 0;
    return true;
  }

  const ClusterProblem& problem_;
  const std::vector<Sight>& sights_;
  std::vector<uint8_t> is_trusted_;
};

/// The system of PlaceByPositions: three unknowns per image, and a height per drive.
class PositionSystem {
 public:
  PositionSystem(const ClusterProblem& problem,
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

  /// False when the system has no solution.
  bool Solve(double scatter) {
    for (int round = 0; round <= kReweightings; ++round) {
      if (!SolveOnce(scatter, round)) return false;
    }
    return true;
  }

  /// Heights are over the origin of the first drive.
  [[nodiscard]] Vector3d Centre(ImageSlot image) const {
    return At(row_[image]) + heights_[0] * Vector3d::UnitZ();
  }
  /// By how much positions of a drive are higher.
  [[nodiscard]] double HeightOffset(uint32_t drive) const {
    const auto origin = origins_.find(drive);
    return origin == origins_.end() ? 0.0 : heights_[origin->second] - heights_[0];
  }

 private:
  [[nodiscard]] Eigen::Index NumImages() const { return static_cast<Eigen::Index>(images_.size()); }
  [[nodiscard]] Vector3d At(int row) const { return centres_.row(row).transpose(); }

  [[nodiscard]] bool IsTrusted(ImageSlot image) const {
    return is_trusted_[static_cast<size_t>(row_[image])] != 0;
  }

  /// To begin with; where there is none that is trusted, on that of the strongest sight.
  void StandOnPositions() {
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

  void AddPositions(double scatter, int round) {
    for (int row = 0; row < NumImages(); ++row) {
      const ClusterImage& image = problem_.images[images_[static_cast<size_t>(row)]];
      const bool is_heard = round >= kFirstRounds || is_trusted_[static_cast<size_t>(row)] != 0;
      if (!image.prior.position_in_enu || !is_heard) continue;
      const Vector3d& position = *image.prior.position_in_enu;
      AddPlan(row, position, scatter * image.prior.horizontal_sigma_m);
      AddHeight(
          row, origins_.at(image.drive), position.z(), scatter * image.prior.vertical_sigma_m);
    }
  }

  void AddPlan(int row, const Vector3d& position, double sigma_m) {
    const double squared = (At(row) - position).head<2>().squaredNorm() / (sigma_m * sigma_m);
    const double weight = WeightOf(squared) / (sigma_m * sigma_m);
    for (const int axis : {0, 1}) {
      left_.emplace_back(3 * row + axis, 3 * row + axis, weight);
      right_[3 * row + axis] += weight * position[axis];
    }
  }

  void AddHeight(int row, int origin, double height_m, double sigma_m) {
    const double error = (centres_(row, 2) + heights_[origin] - height_m) / sigma_m;
    const double weight = WeightOf(error * error) / (sigma_m * sigma_m);
    const int places[] = {3 * row + 2, static_cast<int>(3 * NumImages()) + origin};
    for (const int i : places) {
      right_[i] += weight * height_m;
      for (const int j : places) left_.emplace_back(i, j, weight);
    }
  }

  /// `slack_m`: of where images stand so far.
  void AddSight(const Sight& sight, double slack_m) {
    const int a = row_[sight.a];
    const int b = row_[sight.b];
    const Vector3d step = At(b) - At(a);
    const double along_m = step.dot(sight.direction);
    // What leads backwards is wrong.
    if (along_m < -slack_m) return;
    const Matrix3d along = sight.direction * sight.direction.transpose();
    const double sigma_m = std::hypot(kLeastSigma_m, kDirectionSigmaRad * step.norm(), slack_m);
    const double across = (step - along_m * sight.direction).squaredNorm() / (sigma_m * sigma_m);
    const double weight = sight.weight * WeightOf(across);
    Matrix3d information = weight / (sigma_m * sigma_m) * (Matrix3d::Identity() - along);
    Vector3d value = Vector3d::Zero();
    if (sight.length_m > 0.0) {
      const double length_sigma_m = std::hypot(kLengthShare * sight.length_m, slack_m);
      const double error = (along_m - sight.length_m) / length_sigma_m;
      const double length_weight = weight * WeightOf(error * error);
      information += length_weight / (length_sigma_m * length_sigma_m) * along;
      value = sight.length_m * sight.direction;
    }
    AddStep(a, b, information, value);
  }

  /// (x_b - x_a - value)^T information (x_b - x_a - value).
  void AddStep(int a, int b, const Matrix3d& information, const Vector3d& value) {
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

  bool SolveOnce(double scatter, int round) {
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

std::vector<Sight> SightsOf(const ClusterProblem& problem,
                            const PairDirections& pairs,
                            const Eigen::Quaterniond& enu_from_world) {
  std::vector<Sight> sights;
  for (size_t e = 0; e < pairs.edges.size(); ++e) {
    sights.push_back({pairs.edges[e].pair.a.value,
                      pairs.edges[e].pair.b.value,
                      (enu_from_world * pairs.Direction(e)).normalized(),
                      pairs.edges[e].num_inliers});
  }
  GuessLengthsOfSteps(
      problem, [](ImageSlot) { return true; }, sights);
  return sights;
}

double ScatterAbout(const ClusterProblem& problem,
                    std::span<const ImageSlot> images,
                    const PositionSystem& system) {
  std::vector<double> errors;
  for (const ImageSlot image : images) {
    const PosePrior& prior = problem.images[image].prior;
    if (!prior.position_in_enu) continue;
    const Vector3d error = system.Centre(image) - *prior.position_in_enu;
    errors.push_back(error.head<2>().norm() / prior.horizontal_sigma_m);
  }
  return ScatterOfPositions(errors);
}

}  // namespace

absl::StatusOr<PairPlacement> PlaceByPositions(const ClusterProblem& problem,
                                               const CorrespondenceGraph& graph,
                                               std::span<const uint8_t> available,
                                               const MappingOptions& options,
                                               const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PairDirections pairs,
                            FindPairDirections(problem, graph, available, options, context));
  PairPlacement placement{.images = JoinedImages(pairs)};
  const std::vector<ImageSlot>& images = placement.images;
  if (!DoPositionsSpread(problem, images, 1.0)) return PairPlacement{};
  const Eigen::Quaterniond enu_from_world = EnuFromDisplacements(
      problem, images, pairs.cams_from_world, DirectionsAsLongAsPositions(problem, pairs));
  PositionSystem system(problem, images, SightsOf(problem, pairs, enu_from_world));
  if (!system.Solve(kLeastScatter)) return PairPlacement{};
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  const double scatter = std::max(kLeastScatter, ScatterAbout(problem, images, system));
  if (!DoPositionsSpread(problem, images, scatter) || !system.Solve(scatter))
    return PairPlacement{};
  const auto centre_of = [&](ImageSlot image) { return system.Centre(image); };
  if (ShareOnPositions(problem, images, scatter, centre_of) < kMinAgreeing) return PairPlacement{};
  placement.position_factor = scatter;
  for (const ClusterImage& image : problem.images)
    placement.height_offset_m.push_back(system.HeightOffset(image.drive));
  for (const ImageSlot image : images) {
    placement.cams_from_world.push_back(Rigid3::FromCentre(
        pairs.cams_from_world[image] * enu_from_world.conjugate(), system.Centre(image)));
  }
  return placement;
}

}  // namespace orbweave
