// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// The images of every drive in the order in which they were taken: by capture time where all
/// images of the drive have a finite one (equal times by id), else by id, which follows the names.
/// Every image of the manifest is in exactly one sequence.
[[nodiscard]] std::map<uint32_t, std::vector<ImageId>> SequenceOfDrives(
    const ImageManifest& manifest);

/// Whether all of these images have a finite capture time: then they are in its order.
[[nodiscard]] bool HaveTimes(const ImageManifest& manifest, std::span<const ImageId> sequence);

}  // namespace orbweave
