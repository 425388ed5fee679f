// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/graph/disjoint_sets.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// Panoramas of a model that hang at the rest of it by few points.
struct HingedPiece {
  std::vector<ImageId> images{};  ///< ascending
  uint32_t points = 0;            ///< that three panoramas see, in the piece and outside
};

/// Finds what hangs at a model by fewer points than tell its size (kFewestThatTellSize), track by
/// track. Two panoramas alone say which way one lies from the other; how long the step between them
/// is, and so how large what lies behind it, only points that a third one sees tell: of those,
/// so many hold panoramas together, and pieces of such panoramas in turn, until no two
/// pieces have as many in common. Which pieces are left does not depend on the order of tracks.
///
/// Memory: a place per panorama, and the tracks that are seen from several pieces; time linear in
/// the observations, but for these.
class HingeFinder {
 public:
  /// Of a model with these images; loose ones are in no piece.
  explicit HingeFinder(const std::map<ImageId, RegisteredImage>& images);

  void Add(const Track& track);
  /// All pieces but the one of most images; those of most images first.
  [[nodiscard]] std::vector<HingedPiece> Finish() &&;

 private:
  using Place = uint32_t;  // among the images

  /// The pieces that see an open track, ascending.
  [[nodiscard]] std::vector<Place> PiecesOf(const std::vector<Place>& track);
  [[nodiscard]] bool UnitePieces();
  void Reduce();

  std::vector<ImageId> images_{};  // ascending
  DisjointSets pieces_;
  std::vector<std::vector<Place>> open_{};  // tracks that several pieces see
  size_t pairs_ = 0;                        // of pieces, one for each track that sees both
  size_t pairs_to_reduce_;
};

}  // namespace orbweave
