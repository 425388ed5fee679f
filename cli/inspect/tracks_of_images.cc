// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/inspect/tracks_of_images.h"

#include "core/bundle/bearing_error.h"

namespace orbweave {

void TracksOfImages::BeginModel(const std::map<ImageId, RegisteredImage>& images,
                                const ImageManifest& manifest) {
  model_ = &images;
  manifest_ = &manifest;
}

void TracksOfImages::TakePoint(const Track& track) {
  size_t num_seen = 0;
  for (const Observation& seen : track.observations) {
    if (!images_.contains(seen.ref.image)) continue;
    ++num_seen;
    const double error_rad =
        BearingError(model_->at(seen.ref.image).cam_from_world, track.point_in_world, seen.bearing);
    features_[seen.ref.image][seen.ref.feature] = {
        .track_length = static_cast<uint32_t>(track.observations.size()),
        .residual_px = manifest_->At(seen.ref.image).camera.PixelsFromAngle(error_rad)};
  }
  if (num_seen == images_.size()) ++num_common_;
}

}  // namespace orbweave
