// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/reconstruction.h"

namespace orbweave {

/// A feature and the position of the track that holds it.
struct TrackedFeature {
  FeatureRef ref{};
  uint32_t track = 0;
};

/// All observations of a reconstruction, sorted by feature.
[[nodiscard]] std::vector<TrackedFeature> IndexFeatures(const Reconstruction& reconstruction);

/// The part of a feature index that belongs to one image.
[[nodiscard]] std::span<const TrackedFeature> FeaturesOf(std::span<const TrackedFeature> index,
                                                         ImageId image);

/// Tracks of two reconstructions that hold a feature in common: the same scene point.
struct CommonTrack {
  uint32_t track_a = 0;
  uint32_t track_b = 0;
};

struct CommonView {
  std::vector<ImageId> images{};      ///< registered in both and loose in neither, sorted
  std::vector<CommonTrack> tracks{};  ///< every track at most once, sorted
};

/// What two reconstructions have in common. Where a track meets several of the other side, the one
/// with most common features counts.
[[nodiscard]] CommonView FindCommonView(const Reconstruction& a,
                                        std::span<const TrackedFeature> index_a,
                                        const Reconstruction& b,
                                        std::span<const TrackedFeature> index_b);

}  // namespace orbweave
