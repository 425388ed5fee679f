// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/sample_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr int kSteps = 32;  // positions per pixel
constexpr int kUpper = 4;   // face (cube_face.h)

using CubicWeights = std::array<std::array<int, 4>, kSteps>;

/// Weights of the four pixels around a position, that sum to 128.
CubicWeights MakeCubicWeights() {
  CubicWeights weights;
  for (int k = 0; k < kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    const double w0 = ((-0.5 * t + 1.0) * t - 0.5) * t;
    const double w1 = (1.5 * t - 2.5) * t * t + 1.0;
    const double w2 = ((-1.5 * t + 2.0) * t + 0.5) * t;
    auto& w = weights[static_cast<size_t>(k)];
    w[0] = static_cast<int>(std::lround(128.0 * w0));
    w[1] = static_cast<int>(std::lround(128.0 * w1));
    w[2] = static_cast<int>(std::lround(128.0 * w2));
    w[3] = 128 - w[0] - w[1] - w[2];
  }
  return weights;
}

int32_t InSteps(double position) { return static_cast<int32_t>(std::lround(position * kSteps)); }

/// Position of each pixel of a row of a face, in steps.
struct RowPlaces {
  std::vector<int32_t> columns{};
  std::vector<int32_t> rows{};
};

RowPlaces PlacesOf(const FaceMap& map, int face, int row) {
  const auto size = static_cast<size_t>(map.size_px);
  const int32_t turn = map.width_px * kSteps;
  RowPlaces places{std::vector<int32_t>(size), std::vector<int32_t>(size)};
  if (face < kUpper) {
    const int32_t* const rows = map.side_rows.data() + static_cast<size_t>(row) * size;
    for (size_t k = 0; k < size; ++k) {
      const int32_t column = map.side_columns[k] + face * (turn / 4);
      places.columns[k] = column >= turn ? column - turn : column;
      places.rows[k] = rows[k];
    }
    return places;
  }
  const bool upper = face == kUpper;
  const auto from = static_cast<size_t>(upper ? row : map.size_px - 1 - row) * size;
  const int32_t last = (map.height_px - 1) * kSteps;
  for (size_t k = 0; k < size; ++k) {
    places.columns[k] = map.upper_columns[from + k];
    places.rows[k] = upper ? map.upper_rows[from + k] : last - map.upper_rows[from + k];
  }
  return places;
}

uint8_t Interpolate(const GreyPanorama& panorama,
                    int32_t row,
                    int32_t column,
                    const CubicWeights& weights) {
  const auto& across = weights[static_cast<size_t>(column & (kSteps - 1))];
  const auto& down = weights[static_cast<size_t>(row & (kSteps - 1))];
  const int stride = panorama.Stride();
  const uint8_t* p = panorama.At((row >> 5) - 1, (column >> 5) - 1);
  int sum = 0;
  for (size_t j = 0; j < 4; ++j, p += stride) {
    sum += down[j] * (across[0] * p[0] + across[1] * p[1] + across[2] * p[2] + across[3] * p[3]);
  }
  return static_cast<uint8_t>(std::clamp((sum + (1 << 13)) >> 14, 0, 255));
}

}  // namespace

FaceMap MakeFaceMap(int width_px, int height_px, std::span<const double> tangents) {
  using std::numbers::pi;
  const size_t size = tangents.size();
  FaceMap map{.size_px = static_cast<int>(size), .width_px = width_px, .height_px = height_px};
  const double columns_per_rad = width_px / (2.0 * pi);
  const double rows_per_rad = height_px / pi;
  const int32_t turn = width_px * kSteps;
  for (const double x : tangents) {
    map.side_columns.push_back(InSteps(0.5 * width_px - 0.5 + std::atan(x) * columns_per_rad));
  }
  map.side_rows.reserve(size * size);
  map.upper_columns.reserve(size * size);
  map.upper_rows.reserve(size * size);
  for (const double y : tangents) {
    for (const double x : tangents) {
      const double latitude_rad = std::atan(y / std::sqrt(1.0 + x * x));
      map.side_rows.push_back(InSteps(0.5 * height_px - 0.5 + latitude_rad * rows_per_rad));
      const double longitude_rad = std::atan2(x, y);
      const int32_t column = InSteps(0.5 * width_px - 0.5 + longitude_rad * columns_per_rad);
      map.upper_columns.push_back(column < 0 ? column + turn : column);
      const double to_pole_rad = std::atan(std::sqrt(x * x + y * y));
      map.upper_rows.push_back(InSteps(to_pole_rad * rows_per_rad - 0.5));
    }
  }
  return map;
}

std::vector<uint8_t> SampleFace(const FaceMap& map, const GreyPanorama& panorama, int face) {
  static const CubicWeights kWeights = MakeCubicWeights();
  std::vector<uint8_t> levels;
  levels.reserve(static_cast<size_t>(map.size_px) * static_cast<size_t>(map.size_px));
  for (int row = 0; row < map.size_px; ++row) {
    const RowPlaces places = PlacesOf(map, face, row);
    for (size_t k = 0; k < places.rows.size(); ++k) {
      levels.push_back(Interpolate(panorama, places.rows[k], places.columns[k], kWeights));
    }
  }
  return levels;
}

std::vector<uint8_t> SampleIgnored(const FaceMap& map, const GreyPanorama& panorama, int face) {
  if (panorama.ignored.empty()) return {};
  std::vector<uint8_t> ignored;
  for (int row = 0; row < map.size_px; ++row) {
    const RowPlaces places = PlacesOf(map, face, row);
    for (size_t k = 0; k < places.rows.size(); ++k) {
      const int v = std::clamp((places.rows[k] + kSteps / 2) >> 5, 0, map.height_px - 1);
      const int u = ((places.columns[k] + kSteps / 2) >> 5) % map.width_px;
      ignored.push_back(
          panorama.ignored[static_cast<size_t>(v) * static_cast<size_t>(map.width_px) +
                           static_cast<size_t>(u)]);
    }
  }
  return ignored;
}

}  // namespace orbweave
