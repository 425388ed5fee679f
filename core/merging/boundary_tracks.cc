// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/boundary_tracks.h"

#include <algorithm>
#include <iterator>

namespace orbweave {
namespace {

bool IsOnRim(const Track& track, const std::vector<ImageId>& shared) {
  return std::ranges::any_of(track.observations, [&](const Observation& seen) {
    return std::ranges::binary_search(shared, seen.ref.image);
  });
}

}  // namespace

Reconstruction BoundaryTracksOf(const Reconstruction& submodel,
                                const std::vector<ImageId>& shared) {
  Reconstruction boundary{.images = submodel.images};
  std::ranges::copy_if(submodel.tracks,
                       std::back_inserter(boundary.tracks),
                       [&](const Track& track) { return IsOnRim(track, shared); });
  return boundary;
}

Reconstruction InteriorTracksOf(const Reconstruction& submodel,
                                const std::vector<ImageId>& shared) {
  Reconstruction inner{.images = submodel.images};
  std::ranges::copy_if(submodel.tracks, std::back_inserter(inner.tracks), [&](const Track& track) {
    return !IsOnRim(track, shared);
  });
  return inner;
}

}  // namespace orbweave
