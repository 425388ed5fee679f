// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/octahedral_normal.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

constexpr float kScale = 32767.0F;

float SignOf(float value) { return value < 0.0F ? -1.0F : 1.0F; }

int16_t Quantised(float value) {
  return static_cast<int16_t>(std::lround(std::clamp(value, -1.0F, 1.0F) * kScale));
}

}  // namespace

OctahedralNormal EncodeNormal(const Eigen::Vector3f& unit) {
  const Eigen::Vector3f n = unit / unit.lpNorm<1>();
  if (n.z() >= 0.0F) return {Quantised(n.x()), Quantised(n.y())};
  return {Quantised((1.0F - std::abs(n.y())) * SignOf(n.x())),
          Quantised((1.0F - std::abs(n.x())) * SignOf(n.y()))};
}

Eigen::Vector3f DecodeNormal(const OctahedralNormal& normal) {
  const float u = static_cast<float>(normal.u) / kScale;
  const float v = static_cast<float>(normal.v) / kScale;
  const float z = 1.0F - std::abs(u) - std::abs(v);
  if (z >= 0.0F) return Eigen::Vector3f(u, v, z).normalized();
  return Eigen::Vector3f((1.0F - std::abs(v)) * SignOf(u), (1.0F - std::abs(u)) * SignOf(v), z)
      .normalized();
}

}  // namespace orbweave
