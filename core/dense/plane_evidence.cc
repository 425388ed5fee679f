// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/plane_evidence.h"

#include <algorithm>

#include "core/dense/patch_batch.h"
#include "core/dense/square_sums.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
/// Weight of a patch without texture, which correlates with nothing.
constexpr float kLeastWeight = 0.05F;

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
          correlation[row * cells + column] = products.Around(row, column, kEvidenceReach) /
                                              weights.Around(row, column, kEvidenceReach);
        }
      }
    }
  }
  return evidence;
}

}  // namespace orbweave
