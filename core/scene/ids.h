// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "core/base/strong_id.h"

namespace orbweave {

/// Position of an image in the job's natural order: 0 ... number of images - 1. Global from ingest
/// on.
using ImageId = StrongId<struct ImageTag>;
/// Index of a keypoint within its image's Features.
using FeatureIndex = uint32_t;

/// Two different images, a < b.
struct ImagePair {
  ImageId a;
  ImageId b;
  friend auto operator<=>(const ImagePair&, const ImagePair&) = default;
};

inline ImagePair MakePair(ImageId x, ImageId y) {
  return x < y ? ImagePair{x, y} : ImagePair{y, x};
}

/// One keypoint of one image: the unit of identity of the whole house. A track is named by its
/// smallest FeatureRef.
struct FeatureRef {
  ImageId image;
  FeatureIndex feature = 0;
  friend auto operator<=>(const FeatureRef&, const FeatureRef&) = default;
};

/// Keypoint a of image pair.a corresponds to keypoint b of image pair.b.
struct FeatureMatch {
  FeatureIndex a = 0;
  FeatureIndex b = 0;
  friend auto operator<=>(const FeatureMatch&, const FeatureMatch&) = default;
};

}  // namespace orbweave
