// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// A step of a drive that leads hardly anywhere, or back, and is doubted.
struct ShortStep {
  ImageId from{};
  ImageId to{};
  double steps = 0.0;            ///< how far it leads on, in steps as they are around it
  std::optional<ImageId> end{};  ///< the one of them that nothing else holds (VanishedStep::end)
};

/// FindVanishedSteps of every drive, as far as positions do not bear them out (IsDoubted). Drives
/// and their order: StopsOfDrives.
[[nodiscard]] std::vector<ShortStep> FindShortSteps(
    const std::map<ImageId, RegisteredImage>& images, const ImageManifest& manifest);

/// "vanished_steps": whether a step of an even drive leads hardly anywhere, or back
/// (FindShortSteps).
///
/// Value: how many steps the worst is short, up to one, or more where it leads back; 0 where none
/// is.
[[nodiscard]] CrossCheck CheckVanishedSteps(const std::map<ImageId, RegisteredImage>& images,
                                            const ImageManifest& manifest);

}  // namespace orbweave
