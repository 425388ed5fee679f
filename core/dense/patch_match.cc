// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/patch_match.h"

#include <algorithm>

#include "core/dense/patch_batch.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;

/// Calls visit(place, views) for the batches of a colour, block after block.
template <typename Visitor>
void ForEachBatch(int face_px, const BlockViews& views, int colour, Visitor&& visit) {
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int block_row = 0; block_row < views.rows; ++block_row) {
      const int last = std::min(face_px, (block_row + 1) * kBlockRows_px);
      for (int block_column = 0; block_column < views.columns; ++block_column) {
        for (int row = block_row * kBlockRows_px; row < last; ++row) {
          const int in_field = kApron + row;
          const int column = kApron + block_column * kBlockColumns_px + ((in_field + colour) & 1);
          visit(MatchPlace{face, in_field, column}, views.At(face, block_row, block_column));
        }
      }
    }
  }
}

}  // namespace

void RunRound(const PatchMatchContext& context, const PatchMatchRound& round, PlaneField& field) {
  PatchBatch batch(context, round, field);
  for (const int colour : {0, 1}) {
    field.FillAprons();
    ForEachBatch(field.FacePx(),
                 context.views,
                 colour,
                 [&](const MatchPlace& place, const ChosenViews& views) {
                   if (!batch.Load(place, colour, views)) return;
                   batch.TryNeighbours();
                   batch.TryRandom();
                   if (round.refine_px > 0.0F) batch.Refine();
                   batch.Store();
                 });
  }
}

void DropSky(const PatchMatchContext& context, PlaneField& field) {
  const PatchMatchRound none{.views_changed = false};
  PatchBatch batch(context, none, field);
  for (const int colour : {0, 1}) {
    ForEachBatch(field.FacePx(),
                 context.views,
                 colour,
                 [&](const MatchPlace& place, const ChosenViews& views) {
                   if (!batch.Load(place, colour, views)) return;
                   batch.DropSky();
                   batch.Store();
                 });
  }
}

void TryPrior(const PatchMatchContext& context, const PlanarPrior& prior, PlaneField& field) {
  const PatchMatchRound none{.views_changed = false};
  PatchBatch batch(context, none, field);
  for (const int colour : {0, 1}) {
    ForEachBatch(field.FacePx(),
                 context.views,
                 colour,
                 [&](const MatchPlace& place, const ChosenViews& views) {
                   if (!batch.Load(place, colour, views, true)) return;
                   batch.TryPrior(prior);
                   batch.Store();
                 });
  }
}

}  // namespace orbweave
