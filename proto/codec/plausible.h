// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ranges>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/geometry/sim3.h"

/// What numbers of an artifact may be. What is beyond was computed by nobody, and who computes with
/// it gets no number.

namespace orbweave::codec {

/// Of places of cameras and of positions, in metres or units of a model.
inline constexpr double kMostLength = 1e9;
/// Of a coordinate of a point that rays all but parallel meet in: a float still holds it.
inline constexpr double kFarthestPoint = 1e30;
/// Of all else: its square is a number too.
inline constexpr double kMostNumber = 1e100;
inline constexpr double kLeastSigma = 1e-12;
/// Of one side of a picture.
inline constexpr int kMostPixels = 1 << 20;

[[nodiscard]] inline bool IsNumber(double value) { return std::abs(value) <= kMostNumber; }
[[nodiscard]] inline bool IsAmount(double value) { return value >= 0.0 && value <= kMostNumber; }
[[nodiscard]] inline bool IsLength(double value) { return std::abs(value) <= kMostLength; }
[[nodiscard]] inline bool IsDistance(double value) { return value >= 0.0 && value <= kMostLength; }
[[nodiscard]] inline bool IsSigma(double value) {
  return value >= kLeastSigma && value <= kMostLength;
}
[[nodiscard]] inline bool IsShare(double value) { return value >= 0.0 && value <= 1.0; }
[[nodiscard]] inline bool IsSize(int pixels) { return pixels > 0 && pixels <= kMostPixels; }

/// Of a column of the world as wide as a quantum of positions or more.
[[nodiscard]] inline bool IsCellNumber(int64_t number) {
  constexpr int64_t kMost = 2'000'000'000'000;
  return number >= -kMost && number <= kMost;
}

template <typename Matrix>
[[nodiscard]] bool AreNumbers(const Eigen::MatrixBase<Matrix>& values) {
  return (values.array().abs() <= kMostNumber).all();
}
template <typename Matrix>
[[nodiscard]] bool IsPlace(const Eigen::MatrixBase<Matrix>& coordinates) {
  return (coordinates.array().abs() <= kMostLength).all();
}
template <typename Matrix>
[[nodiscard]] bool IsPoint(const Eigen::MatrixBase<Matrix>& coordinates) {
  return (coordinates.array().abs() <= kFarthestPoint).all();
}
[[nodiscard]] inline bool IsDirection(const Eigen::Vector3d& vector) {
  return std::abs(vector.norm() - 1.0) < 1e-6;
}

/// Where a submodel lies in a world, or a world on earth.
[[nodiscard]] inline bool IsPlacement(const Sim3& similarity) {
  return IsPlace(similarity.translation) && similarity.scale >= 1.0 / kMostLength &&
         similarity.scale <= kMostLength;
}

/// None has another bit than `all`.
template <typename Range>
[[nodiscard]] bool AreFlags(const Range& flags, unsigned all) {
  return std::ranges::all_of(flags, [all](unsigned flag) { return (flag & ~all) == 0; });
}

/// Every one is more than the one before.
template <typename Range, typename Projection = std::identity>
[[nodiscard]] bool Ascends(const Range& values, Projection projection = {}) {
  return std::ranges::adjacent_find(values, std::ranges::greater_equal{}, projection) ==
         std::ranges::end(values);
}

/// DataLoss unless `is_so`.
inline absl::Status Expect(bool is_so, const char* what, const char* fault) {
  if (is_so) return absl::OkStatus();
  return absl::DataLossError(absl::StrCat(what, ": ", fault));
}

}  // namespace orbweave::codec
