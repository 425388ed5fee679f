// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_path.h"

#include <algorithm>
#include <cmath>

#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr int kChordsPerCorner = 32;

/// The arc that replaces `corner`, from the side towards `before` to the side towards `after`.
std::vector<Eigen::Vector2d> RoundCorner(const Eigen::Vector2d& before,
                                         const Eigen::Vector2d& corner,
                                         const Eigen::Vector2d& after,
                                         double radius_m) {
  const Eigen::Vector2d in = (corner - before).normalized();
  const Eigen::Vector2d out = (after - corner).normalized();
  const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  const double half_tangent = std::tan(std::abs(turn) / 2.0);
  if (half_tangent < 1e-9) return {corner};
  const double room = 0.5 * std::min((corner - before).norm(), (after - corner).norm());
  const double cut = std::min(radius_m * half_tangent, room);
  const double r = cut / half_tangent;
  const Eigen::Vector2d start = corner - cut * in;
  const Eigen::Vector2d left(-in.y(), in.x());
  std::vector<Eigen::Vector2d> arc;
  for (int i = 0; i <= kChordsPerCorner; ++i) {
    const double angle = std::abs(turn) * i / kChordsPerCorner;
    arc.push_back(start + r * std::sin(angle) * in +
                  std::copysign(r * (1.0 - std::cos(angle)), turn) * left);
  }
  return arc;
}

}  // namespace

StreetPath::StreetPath(const std::vector<Eigen::Vector2d>& corners, double radius_m, bool closed)
    : closed_(closed) {
  const size_t n = corners.size();
  ORBWEAVE_CHECK(n >= 2);
  for (size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i + 1 == n)) {
      Append(corners[i]);
      continue;
    }
    for (const Eigen::Vector2d& vertex :
         RoundCorner(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n], radius_m)) {
      Append(vertex);
    }
  }
  if (closed) Append(Eigen::Vector2d(vertices_.front()));
  ORBWEAVE_CHECK(vertices_.size() >= 2);
}

void StreetPath::Append(const Eigen::Vector2d& vertex) {
  if (vertices_.empty()) {
    vertices_.push_back(vertex);
    stations_m_.push_back(0.0);
    return;
  }
  const double step_m = (vertex - vertices_.back()).norm();
  if (step_m < 1e-9) return;
  stations_m_.push_back(stations_m_.back() + step_m);
  vertices_.push_back(vertex);
}

PathPlace StreetPath::At(double station_m) const {
  if (closed_) station_m -= std::floor(station_m / length_m()) * length_m();
  const auto above = std::upper_bound(stations_m_.begin() + 1, stations_m_.end() - 1, station_m);
  const auto i = static_cast<size_t>(above - stations_m_.begin());
  const Eigen::Vector2d direction = (vertices_[i] - vertices_[i - 1]).normalized();
  return {vertices_[i - 1] + (station_m - stations_m_[i - 1]) * direction, direction};
}

}  // namespace orbweave
