// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/bearing_points.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// 2 - 2 cos e for the data [begin, end). NaN for a point in the centre, which no threshold admits.
void SquaredChords(
    const BearingPoints& data, const Rigid3& pose, size_t begin, size_t end, double* chords) {
  const Eigen::Matrix3d R = pose.rotation.toRotationMatrix();
  const Vector3d t = pose.translation;
  const double* const X = data.P[0].data() + begin;
  const double* const Y = data.P[1].data() + begin;
  const double* const Z = data.P[2].data() + begin;
  const double* const bx = data.b[0].data() + begin;
  const double* const by = data.b[1].data() + begin;
  const double* const bz = data.b[2].data() + begin;
  for (size_t i = 0; i < end - begin; ++i) {
    const double x = R(0, 0) * X[i] + R(0, 1) * Y[i] + R(0, 2) * Z[i] + t.x();
    const double y = R(1, 0) * X[i] + R(1, 1) * Y[i] + R(1, 2) * Z[i] + t.y();
    const double z = R(2, 0) * X[i] + R(2, 1) * Y[i] + R(2, 2) * Z[i] + t.z();
    const double along = bx[i] * x + by[i] * y + bz[i] * z;
    chords[i] = 2.0 - 2.0 * along / std::sqrt(x * x + y * y + z * z);
  }
}

double MaxSquaredChord(double max_error_rad) { return 2.0 - 2.0 * std::cos(max_error_rad); }

}  // namespace

BearingPoints ArrangePoints(std::span<const Vector3d> bearings,
                            std::span<const Vector3d> points_in_world,
                            uint64_t seed) {
  BearingPoints data;
  data.order = ShuffledOrder(static_cast<uint32_t>(bearings.size()), seed);
  if (!points_in_world.empty()) data.origin = points_in_world[0];
  for (int k = 0; k < 3; ++k) {
    data.b[k].reserve(data.Size());
    data.P[k].reserve(data.Size());
    for (const uint32_t i : data.order) {
      data.b[k].push_back(bearings[i][k]);
      data.P[k].push_back(points_in_world[i][k] - data.origin[k]);
    }
  }
  return data;
}

std::optional<RansacScore> ScorePose(const BearingPoints& data,
                                     const Rigid3& cam_from_origin,
                                     double max_error_rad,
                                     const EarlyRejection& gate) {
  const double max_squared_chord = MaxSquaredChord(max_error_rad);
  std::array<double, EarlyRejection::kBlock> chords;
  RansacScore score;
  for (size_t begin = 0; begin < data.Size(); begin += chords.size()) {
    const size_t end = std::min(begin + chords.size(), data.Size());
    SquaredChords(data, cam_from_origin, begin, end, chords.data());
    for (size_t i = 0; i < end - begin; ++i) {
      const bool inlier = chords[i] < max_squared_chord;
      score.cost += inlier ? chords[i] : max_squared_chord;
      score.num_inliers += inlier ? 1U : 0U;
    }
    if (gate.Rejects(score.cost, score.num_inliers, end)) return std::nullopt;
  }
  return score;
}

std::vector<uint32_t> PoseInliers(const BearingPoints& data,
                                  const Rigid3& cam_from_origin,
                                  double max_error_rad) {
  const double max_squared_chord = MaxSquaredChord(max_error_rad);
  std::vector<double> chords(data.Size());
  SquaredChords(data, cam_from_origin, 0, data.Size(), chords.data());
  std::vector<uint32_t> inliers;
  for (uint32_t i = 0; i < chords.size(); ++i) {
    if (chords[i] < max_squared_chord) inliers.push_back(i);
  }
  return inliers;
}

}  // namespace orbweave
