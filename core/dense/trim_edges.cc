// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/dense/trim_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// One face of a map before anything was taken away, continued by kAround_px pixels.
class Face {
 public:
  Face(const ReferenceRaster& raster, const PlaneField& field, const DepthMap& map, int face)
      : field_(field), face_(face), size_(map.face_px), stride_(size_ + 2 * kAround_px), map_(map) {
    const auto f = static_cast<size_t>(face);
    for (int row = -kAround_px; row < size_ + kAround_px; ++row) {
      for (int column = -kAround_px; column < size_ + kAround_px; ++column) {
        const auto in_raster =
            static_cast<size_t>((row + ReferenceRaster::kApron_px) * raster.Stride() + column +
                                ReferenceRaster::kApron_px);
        const bool is_ignored = !raster.ignored[f].empty() && raster.ignored[f][in_raster] != 0;
        const float range = RangeAt(row, column);
        levels_.push_back(raster.levels[f][in_raster]);
        // Blank is behind all; what is ignored is on neither side.
        ranges_.push_back(is_ignored ? kIgnored : range > 0.0F ? range : kBlank);
      }
    }
    FindFarthest();
  }

  [[nodiscard]] bool IsCarriedOver(int row, int column) const {
    const float range = map_.range_m[EquiangularRaster{size_}.Index(face_, row, column)];
    const size_t middle = At(row, column);
    if (!(range > 0.0F) || !(farthest_[middle] > (1.0F + kJump) * range)) return false;
    Levels surface;
    Levels behind;
    const float nearest = (1.0F - kJump) * range;
    const float farthest = (1.0F + kJump) * range;
    for (int r = row - kAround_px; r <= row + kAround_px; ++r) {
      const size_t first = At(r, column - kAround_px);
      for (size_t k = first; k <= first + 2 * kAround_px; ++k) {
        if (k == middle || ranges_[k] < nearest) continue;
        (ranges_[k] > farthest ? behind : surface).Add(levels_[k]);
      }
    }
    if (surface.count < kLeastPixels || behind.count < kLeastPixels) return false;
    if (IsSure(row, column) && !AreToldApart(surface, behind)) return false;
    const int level = levels_[middle];
    return behind.Away(level) < surface.Away(level);
  }

 private:
  static constexpr float kBlank = std::numeric_limits<float>::infinity();
  static constexpr float kIgnored = 0.0F;

  [[nodiscard]] bool IsWithin(int place) const { return place >= 0 && place < size_; }
  [[nodiscard]] size_t At(int row, int column) const {
    return static_cast<size_t>((row + kAround_px) * stride_ + column + kAround_px);
  }

  /// Beyond the face's edges what other faces have there.
  [[nodiscard]] float RangeAt(int row, int column) const {
    const EquiangularRaster raster{size_};
    if (IsWithin(row) && IsWithin(column)) return map_.range_m[raster.Index(face_, row, column)];
    const Eigen::Vector3d bearing = raster.BearingFromPixel(face_, row + 0.5, column + 0.5);
    return map_.range_m[raster.Index(raster.PixelFromBearing(bearing))];
  }

  /// Of the pixels within kBeyond_px of each pixel of the face.
  void FindFarthest() {
    const size_t reach = kBeyond_px;
    const auto stride = static_cast<size_t>(stride_);
    std::vector<float> along_rows(ranges_.size());
    for (size_t k = reach; k + reach < ranges_.size(); ++k)
      along_rows[k] = *std::max_element(&ranges_[k - reach], &ranges_[k + reach] + 1);
    farthest_.resize(ranges_.size());
    for (size_t k = reach * stride; k + reach * stride < ranges_.size(); ++k) {
      float farthest = kIgnored;
      for (size_t r = k - reach * stride; r <= k + reach * stride; r += stride)
        farthest = std::max(farthest, along_rows[r]);
      farthest_[k] = farthest;
    }
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

  const PlaneField& field_;
  int face_;
  int size_;
  int stride_;
  const DepthMap& map_;
  std::vector<uint8_t> levels_{};
  std::vector<float> ranges_{};
  std::vector<float> farthest_{};
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
