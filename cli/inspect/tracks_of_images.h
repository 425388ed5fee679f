// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <utility>

#include "cli/results/fetch_results.h"

namespace orbweave {

/// What a model says of a feature.
struct FeatureInModel {
  uint32_t track_length = 0;
  double residual_px = 0.0;  ///< angle x W / 2pi
};

/// Keeps what the models of a job say of the features of a few images, while they pass by.
class TracksOfImages final : public ModelListener {
 public:
  explicit TracksOfImages(std::set<ImageId> images) : images_(std::move(images)) {}

  void BeginModel(const std::map<ImageId, RegisteredImage>& images,
                  const ImageManifest& manifest) override;
  void TakePoint(const Track& track) override;
  [[nodiscard]] absl::Status EndModel() override { return absl::OkStatus(); }

  /// Empty for an image that no track sees.
  [[nodiscard]] const std::map<FeatureIndex, FeatureInModel>& Of(ImageId image) {
    return features_[image];
  }
  /// Points that all of the images see.
  [[nodiscard]] uint32_t num_common() const { return num_common_; }

 private:
  std::set<ImageId> images_;
  const std::map<ImageId, RegisteredImage>* model_ = nullptr;
  const ImageManifest* manifest_ = nullptr;
  std::map<ImageId, std::map<FeatureIndex, FeatureInModel>> features_{};
  uint32_t num_common_ = 0;
};

}  // namespace orbweave
