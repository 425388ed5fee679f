// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// Down in a camera whose pitch (up) and roll (clockwise) are stated.
[[nodiscard]] Eigen::Vector3d DownInCamera(double pitch_rad, double roll_rad);

/// The attitudes of a drive's panoramas. Where half of those that are registered, loose ones apart,
/// or more state pitch and roll, what these say is taken off: then they are those of the panoramas
/// that state both, from the world to a level camera; else those of all, to the camera.
struct DriveAttitudes {
  uint32_t drive = 0;
  std::vector<ImageId> images{};
  std::vector<Eigen::Matrix3d> level_from_world{};  ///< of each of them
  /// Unit, in the world; zero where it does not move. Of drives in no order (DriveSequences) it may
  /// be the other way.
  std::vector<Eigen::Vector3d> travel{};
  /// Standard deviation of what is taken off, the largest of all; absent where nothing is.
  std::optional<double> stated_sigma_rad{};
  /// They look the same way of the world wherever the drive goes (heading-locked, as panoramas are
  /// that a program turned to the north): no mount that turns with its carrier holds them, so that
  /// none makes all of them lean to one side.
  bool keeps_heading = false;
  size_t num_registered = 0;
  size_t num_stating_both = 0;
  size_t num_stating_any = 0;
};

/// Of every drive with registered images.
[[nodiscard]] std::vector<DriveAttitudes> AttitudesOfDrives(const Reconstruction& reconstruction,
                                                            const ImageManifest& manifest);

}  // namespace orbweave
