// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/dense/trim_edges.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

constexpr int kBeyond_px = 3;  // that patches are led over an edge
constexpr int kAround_px = 6;  // where both sides are looked at: twice as far; within the apron
constexpr float kJump = 0.05F;
constexpr float kLeastScatter = 2.0F;  // levels
constexpr int kLeastPixels = 8;        // of each side, to speak of a mean
constexpr float kSureCost = 0.2F;

/// Mean and scatter of levels.
struct Levels {
  int count = 0;
  int sum = 0;
  int squares = 0;

  void Add(int level) {
    ++count;
    sum += level;
    squares += level * level;
  }
  [[nodiscard]] float Mean() const { return static_cast<float>(sum) / static_cast<float>(count); }
  [[nodiscard]] float Variance() const {
    const float mean = Mean();
    const float variance = static_cast<float>(squares) / static_cast<float>(count) - mean * mean;
    return std::max(variance, kLeastScatter * kLeastScatter);
  }
  /// How far a level is from the mean, in scatters.
  [[nodiscard]] float Away(int level) const {
    return std::abs(static_cast<float>(level) - Mean()) / std::sqrt(Variance());
  }
};

/// One face of a map before anything was taken away.
class Face {
 public:
  Face(const ReferenceRaster& raster, const PlaneField& field, const DepthMap& map, int face)
      : raster_(raster),
        field_(field),
        face_(face),
        size_(map.face_px),
        levels_(raster.levels[static_cast<size_t>(face)]),
        ignored_(raster.ignored[static_cast<size_t>(face)]),
        map_(map) {}

  /// Beyond the face's edges what other faces have there.
  [[nodiscard]] float RangeAt(int row, int column) const {
    const EquiangularRaster raster{size_};
    if (IsWithin(row) && IsWithin(column)) return map_.range_m[raster.Index(face_, row, column)];
    const Eigen::Vector3d bearing = raster.BearingFromPixel(face_, row + 0.5, column + 0.5);
    return map_.range_m[raster.Index(raster.PixelFromBearing(bearing))];
  }

  [[nodiscard]] bool IsCarriedOver(int row, int column) const {
    const float range = RangeAt(row, column);
    if (!(range > 0.0F) || !HasBehind(row, column, range)) return false;
    Levels surface;
    Levels behind;
    for (int r = row - kAround_px; r <= row + kAround_px; ++r) {
      for (int c = column - kAround_px; c <= column + kAround_px; ++c) {
        if (r == row && c == column) continue;
        const Side side = SideOf(r, c, range);
        if (side == Side::kSurface) surface.Add(LevelAt(r, c));
        if (side == Side::kBehind) behind.Add(LevelAt(r, c));
      }
    }
    if (surface.count < kLeastPixels || behind.count < kLeastPixels) return false;
    if (IsSure(row, column) && !AreToldApart(surface, behind)) return false;
    const int level = LevelAt(row, column);
    return behind.Away(level) < surface.Away(level);
  }

 private:
  enum class Side { kSurface, kBehind, kOther };

  [[nodiscard]] bool IsWithin(int place) const { return place >= 0 && place < size_; }
  [[nodiscard]] size_t InRaster(int row, int column) const {
    return static_cast<size_t>((row + ReferenceRaster::kApron_px) * raster_.Stride() + column +
                               ReferenceRaster::kApron_px);
  }
  [[nodiscard]] int LevelAt(int row, int column) const { return levels_[InRaster(row, column)]; }

  [[nodiscard]] Side SideOf(int row, int column, float range) const {
    if (!ignored_.empty() && ignored_[InRaster(row, column)] != 0) return Side::kOther;
    const float other = RangeAt(row, column);
    if (!(other > 0.0F) || other > (1.0F + kJump) * range) return Side::kBehind;
    return other < (1.0F - kJump) * range ? Side::kOther : Side::kSurface;
  }

  [[nodiscard]] bool IsSure(int row, int column) const {
    constexpr int kApron = PlaneField::kApron_px;
    const size_t pixel = EquiangularRaster{size_}.Index(face_, row, column);
    if ((map_.flags[pixel] & kDepthPriorOnly) != 0) return false;
    return field_.cost[field_.AtPixel(face_, row + kApron, column + kApron)] < kSureCost;
  }

  [[nodiscard]] static bool AreToldApart(const Levels& a, const Levels& b) {
    const float contrast = a.Mean() - b.Mean();
    return contrast * contrast > a.Variance() + b.Variance();
  }

  [[nodiscard]] bool HasBehind(int row, int column, float range) const {
    for (int r = row - kBeyond_px; r <= row + kBeyond_px; ++r) {
      for (int c = column - kBeyond_px; c <= column + kBeyond_px; ++c) {
        if (SideOf(r, c, range) == Side::kBehind) return true;
      }
    }
    return false;
  }

  const ReferenceRaster& raster_;
  const PlaneField& field_;
  int face_;
  int size_;
  const std::vector<uint8_t>& levels_;
  const std::vector<uint8_t>& ignored_;
  const DepthMap& map_;
};

}  // namespace

void TrimEdges(const ReferenceRaster& raster, const PlaneField& field, DepthMap& map) {
  std::vector<size_t> carried_over;
  for (int face = 0; face < kCubeFaces; ++face) {
    const Face before(raster, field, map, face);
    for (int row = 0; row < map.face_px; ++row) {
      for (int column = 0; column < map.face_px; ++column) {
        if (before.IsCarriedOver(row, column))
          carried_over.push_back(EquiangularRaster{map.face_px}.Index(face, row, column));
      }
    }
  }
  for (const size_t pixel : carried_over) map.range_m[pixel] = 0.0F;
}

}  // namespace orbweave
