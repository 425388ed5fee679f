// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/rough_places.h"

#include <algorithm>

#include "core/dense/equiangular_raster.h"
#include "core/dense/square_sums.h"
#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

constexpr float kBeside = 4.0F;  // tolerances
constexpr int kReach = 6;
constexpr float kMostBeside = 0.5F;     // of those on the plane
constexpr float kLeastBeside = 200.0F;  // of 676 pixels

size_t CellOf(uint32_t pixel, int face_px) {
  const auto size = static_cast<uint32_t>(face_px);
  const uint32_t row = pixel / size;  // of all faces, one below the other
  return (row / 2) * (size / 2) + pixel % size / 2;
}

/// Points on a plane and beside it, by cell.
struct Counts {
  std::vector<uint16_t> on;
  std::vector<uint16_t> beside;
};

Counts CountAbout(int face_px, const std::vector<ReliablePoint>& points, const FittedPlane& plane) {
  const size_t cells = EquiangularRaster{face_px}.NumPixels() / 4;
  Counts counts{std::vector<uint16_t>(cells), std::vector<uint16_t>(cells)};
  for (const ReliablePoint& point : points) {
    if (!(TolerancesOff(point, plane) < kBeside)) continue;
    ++(LiesOn(point, plane) ? counts.on : counts.beside)[CellOf(point.pixel, face_px)];
  }
  return counts;
}

}  // namespace

RoughPlaces FindRoughPlaces(int face_px,
                            const std::vector<ReliablePoint>& points,
                            const std::vector<FittedPlane>& planes) {
  const int cells = face_px / 2;
  RoughPlaces rough;
  SquareSums on(cells);
  SquareSums beside(cells);
  for (const FittedPlane& plane : planes) {
    const Counts counts = CountAbout(face_px, points, plane);
    std::vector<uint8_t>& of_plane = rough.emplace_back();
    for (int face = 0; face < kCubeFaces; ++face) {
      const size_t first = static_cast<size_t>(face * cells * cells);
      on.Fill([&](int k) { return counts.on[first + static_cast<size_t>(k)]; });
      beside.Fill([&](int k) { return counts.beside[first + static_cast<size_t>(k)]; });
      for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
          const float most = std::max(kLeastBeside, kMostBeside * on.Around(row, column, kReach));
          of_plane.push_back(beside.Around(row, column, kReach) > most ? 1 : 0);
        }
      }
    }
  }
  return rough;
}

}  // namespace orbweave
