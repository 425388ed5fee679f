// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// An even drive along a street.
struct EvenDrive {
  static constexpr uint32_t kImages = 40;
  static constexpr double kStep_m = 8.0;

  EvenDrive() {
    for (uint32_t i = 0; i < kImages; ++i) {
      ImageRecord& image = manifest.images.emplace_back();
      image.id = ImageId(i);
      image.name = std::to_string(i) + ".jpg";
      Move(i, 0.0);
    }
  }

  void Move(uint32_t i, double further_m) { Place(i, {kStep_m * i + further_m, 0.0, 0.0}); }

  void Place(uint32_t i, const Eigen::Vector3d& centre) {
    images[ImageId(i)].cam_from_world = Rigid3::FromCentre(Eigen::Quaterniond::Identity(), centre);
  }

  void Position(uint32_t i, double further_m) {
    PosePrior& prior = manifest.images[i].prior;
    prior.position_in_enu = Eigen::Vector3d(kStep_m * i + further_m, 0.0, 0.0);
    prior.horizontal_sigma_m = 0.5;
  }

  ImageManifest manifest{};
  std::map<ImageId, RegisteredImage> images{};
};

}  // namespace orbweave
