// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/plane_evidence.h"

#include <algorithm>

#include "core/dense/patch_batch.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
/// Weight of a patch without texture, which correlates with nothing.
constexpr float kLeastWeight = 0.05F;

/// Sums over squares of cells of one face, cut at its edges.
class SquareSums {
 public:
  explicit SquareSums(int cells)
      : cells_(cells), sums_(static_cast<size_t>((cells + 1) * (cells + 1))) {}

  template <typename ValueOf>
  void Fill(ValueOf&& value_of) {
    for (int row = 0; row < cells_; ++row) {
      double line = 0.0;
      for (int column = 0; column < cells_; ++column) {
        line += value_of(row * cells_ + column);
        sums_[At(row + 1, column + 1)] = sums_[At(row, column + 1)] + line;
      }
    }
  }

  [[nodiscard]] float Around(int row, int column) const {
    const int top = std::max(0, row - kEvidenceReach);
    const int left = std::max(0, column - kEvidenceReach);
    const int bottom = std::min(cells_, row + kEvidenceReach + 1);
    const int right = std::min(cells_, column + kEvidenceReach + 1);
    return static_cast<float>(sums_[At(bottom, right)] - sums_[At(top, right)] -
                              sums_[At(bottom, left)] + sums_[At(top, left)]);
  }

 private:
  [[nodiscard]] size_t At(int row, int column) const {
    return static_cast<size_t>(row * (cells_ + 1) + column);
  }

  int cells_;
  std::vector<double> sums_;
};

/// Correlations of single patches.
PlaneEvidence MatchPlanes(const PatchMatchContext& context,
                          const std::vector<Eigen::Vector3f>& planes,
                          PlaneField& field) {
  const int cells = field.FacePx() / 2;
  const auto count = static_cast<size_t>(kCubeFaces * cells * cells);
  PlaneEvidence evidence{.cells = cells, .texture = std::vector<float>(count)};
  evidence.correlation.assign(planes.size() + 1, std::vector<float>(count));
  const PatchMatchRound none{.views_changed = false};
  PatchBatch batch(context, none, field);
  LaneFloats cost;
  for (int face = 0; face < kCubeFaces; ++face) {
    const Eigen::Matrix3f face_from_camera = FaceFromCamera(face).cast<float>();
    for (int row = 0; row < cells; ++row) {
      for (int column = 0; column < cells; column += static_cast<int>(kMatchLanes)) {
        const MatchPlace place{face, kApron + 2 * row, kApron + 2 * column};
        const int block_row = 2 * row / kBlockRows_px;
        const int block_column = 2 * column / kBlockColumns_px;
        const ChosenViews& views = context.views.At(face, block_row, block_column);
        if (!batch.Load(place, 0, views, true)) continue;
        const auto at = static_cast<size_t>((face * cells + row) * cells + column);
        for (size_t k = 0; k < batch.NumLanes(); ++k) evidence.texture[at + k] = batch.TextureOf(k);
        const auto note = [&](size_t plane) {
          for (size_t k = 0; k < batch.NumLanes(); ++k)
            evidence.correlation[plane][at + k] = 1.0F - cost[k];
        };
        for (size_t plane = 0; plane < planes.size(); ++plane) {
          batch.ScorePlane(face_from_camera * planes[plane], cost);
          note(plane);
        }
        batch.ScoreSky(cost);
        note(planes.size());
      }
    }
  }
  return evidence;
}

}  // namespace

PlaneEvidence GatherEvidence(const PatchMatchContext& context,
                             const std::vector<Eigen::Vector3f>& planes,
                             PlaneField& field) {
  PlaneEvidence evidence = MatchPlanes(context, planes, field);
  const int cells = evidence.cells;
  SquareSums weights(cells);
  SquareSums products(cells);
  for (int face = 0; face < kCubeFaces; ++face) {
    const size_t first = static_cast<size_t>(face * cells * cells);
    const float* const texture = evidence.texture.data() + first;
    const auto weight_of = [&](int k) { return kLeastWeight + std::min(texture[k], kFullTexture); };
    weights.Fill(weight_of);
    for (std::vector<float>& of_plane : evidence.correlation) {
      float* const correlation = of_plane.data() + first;
      products.Fill([&](int k) { return weight_of(k) * correlation[k]; });
      for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
          correlation[row * cells + column] =
              products.Around(row, column) / weights.Around(row, column);
        }
      }
    }
  }
  return evidence;
}

}  // namespace orbweave
