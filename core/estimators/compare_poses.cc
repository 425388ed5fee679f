// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/estimators/compare_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/base/status.h"
#include "core/estimators/align_cameras.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr int kTrimmedRefits = 30;
constexpr size_t kWindow = 30;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

std::vector<Eigen::Vector3d> Centres(std::span<const Rigid3> cams) {
  std::vector<Eigen::Vector3d> centres;
  for (const Rigid3& cam : cams) centres.push_back(cam.Centre());
  return centres;
}

std::vector<double> Distances(const Sim3& b_from_a,
                              const std::vector<Eigen::Vector3d>& a,
                              const std::vector<Eigen::Vector3d>& b) {
  std::vector<double> distances(a.size());
  for (size_t i = 0; i < a.size(); ++i) distances[i] = (b_from_a * a[i] - b[i]).norm();
  return distances;
}

std::optional<Sim3> FitTrimmed(std::span<const Rigid3> cams_from_a,
                               std::span<const Rigid3> cams_from_b) {
  const std::vector<Eigen::Vector3d> a = Centres(cams_from_a);
  const std::vector<Eigen::Vector3d> b = Centres(cams_from_b);
  std::vector<double> weights(a.size(), 1.0);
  std::optional<Sim3> fit;
  for (int refit = 0; refit < kTrimmedRefits; ++refit) {
    const std::optional<Sim3> next = AlignCameras(cams_from_a, cams_from_b, weights);
    if (!next) return fit;
    fit = next;
    const std::vector<double> distances = Distances(*fit, a, b);
    const double limit = std::max(3.0 * UpperMedian(distances), 1e-9);
    std::vector<double> trimmed(a.size());
    std::transform(distances.begin(), distances.end(), trimmed.begin(), [&](double d) {
      return d <= limit ? 1.0 : 0.0;
    });
    if (trimmed == weights) break;
    weights = std::move(trimmed);
  }
  return fit;
}

double Rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// Errors of all windows of `kWindow` cameras in a row, each after its own similarity; of the whole
/// where it is shorter.
double WindowRmse(std::span<const Rigid3> cams_from_a, std::span<const Rigid3> cams_from_b) {
  const size_t size = std::min(kWindow, cams_from_a.size());
  std::vector<double> errors;
  for (size_t first = 0; first + size <= cams_from_a.size(); ++first) {
    const auto a = cams_from_a.subspan(first, size);
    const auto b = cams_from_b.subspan(first, size);
    const std::optional<Sim3> fit = FitTrimmed(a, b);
    if (!fit) continue;
    const std::vector<double> distances = Distances(*fit, Centres(a), Centres(b));
    errors.insert(errors.end(), distances.begin(), distances.end());
  }
  return Rms(errors);
}

}  // namespace

std::optional<PoseErrors> ComparePoses(std::span<const Rigid3> cams_from_model,
                                       std::span<const Rigid3> cams_from_reference) {
  ORBWEAVE_CHECK(cams_from_model.size() == cams_from_reference.size());
  if (cams_from_model.size() < 3) return std::nullopt;
  const std::vector<Eigen::Vector3d> in_model = Centres(cams_from_model);
  const std::vector<Eigen::Vector3d> in_reference = Centres(cams_from_reference);
  const std::optional<Sim3> fit = FitTrimmed(cams_from_model, cams_from_reference);
  if (!fit) return std::nullopt;

  std::vector<double> rotations_deg;
  std::vector<double> steps;
  for (size_t i = 0; i < in_model.size(); ++i) {
    const Rigid3 aligned = TransformCamera(*fit, cams_from_model[i]);
    rotations_deg.push_back(
        RotationAngle(aligned.rotation * cams_from_reference[i].rotation.conjugate()) * kDegPerRad);
    if (i == 0) continue;
    const Eigen::Vector3d step = fit->scale * (fit->rotation * (in_model[i] - in_model[i - 1]));
    steps.push_back((step - (in_reference[i] - in_reference[i - 1])).norm());
  }
  const std::vector<double> distances = Distances(*fit, in_model, in_reference);
  return PoseErrors{
      .reference_from_model = *fit,
      .position_rmse_m = Rms(distances),
      .position_max_m = *std::max_element(distances.begin(), distances.end()),
      .rotation_median_deg = UpperMedian(rotations_deg),
      .rotation_max_deg = *std::max_element(rotations_deg.begin(), rotations_deg.end()),
      .unaligned_rmse_m = Rms(Distances({}, in_model, in_reference)),
      .neighbour_rmse_m = Rms(steps),
      .window_rmse_m = WindowRmse(cams_from_model, cams_from_reference)};
}

}  // namespace orbweave
