// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/line_pieces.h"

#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/matches_in_planes.h"

namespace orbweave {

LinePieces::LinePieces(const MappingState& state, const MappingOptions& options)
    : state_(state), places_(state, kMatchTolerance * options.max_error_px) {}

std::vector<ImageSlot> LinePieces::Between(ImageSlot first, ImageSlot last) const {
  std::vector<ImageSlot> piece;
  for (size_t place = 0; place < places_.size(); ++place) {
    const ImageSlot image = places_.At(place);
    const std::optional<ImageSlot> on_line =
        AreOfOneLine(image, first) ? image : NearestOf(places_.LineOf(first), image);
    if (!on_line) continue;
    const size_t stands = places_.PlaceOf(*on_line);
    if (places_.PlaceOf(first) <= stands && stands <= places_.PlaceOf(last)) piece.push_back(image);
  }
  return piece;
}

std::vector<ImageSlot> LinePieces::From(ImageSlot first) const {
  size_t last = places_.PlaceOf(first);
  while (last + 1 < places_.size() && AreOfOneLine(places_.At(last + 1), first)) ++last;
  return Between(first, places_.At(last));
}

bool LinePieces::AreOfOneLine(ImageSlot one, ImageSlot other) const {
  return places_.LineOf(one) == places_.LineOf(other);
}

std::optional<ImageSlot> LinePieces::NearestOf(uint32_t line, ImageSlot image) const {
  std::optional<ImageSlot> nearest;
  size_t most = 0;
  for (const uint32_t p : state_.Graph().pairs_of_image[image]) {
    const LinkedPair& pair = state_.Graph().pairs[p];
    const ImageSlot other = pair.Other(image);
    if (!state_.IsRegistered(other) || places_.LineOf(other) != line ||
        !LogLengthOfPair(state_, pair))
      continue;
    const size_t matches = state_.Problem().pairs[pair.index].inliers.size();
    if (matches <= most) continue;
    most = matches;
    nearest = other;
  }
  return nearest;
}

}  // namespace orbweave
