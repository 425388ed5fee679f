// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Images in the order in which they were taken, as far as that is known.
struct TimeOrder {
  std::vector<ImageId> sequence{};
  std::vector<ImageId> unsure{};  ///< without a time, and names do not tell their place either
};

/// Orders `images`, given by id, which follows the names: by capture time (equal times by id). One
/// without a finite time stays where its name has it, between the images with times before and
/// after it by id, where these follow one another by time, too, or all others do on one side of it.
/// Where they do not, it comes after the one before it by id (or before the one after it), and is
/// `unsure`. Without any time the order is that of ids, and nothing unsure.
[[nodiscard]] TimeOrder OrderByTime(const ImageManifest& manifest, std::span<const ImageId> images);

/// The images of every drive by OrderByTime. Every image of the manifest is in exactly one
/// sequence.
[[nodiscard]] std::map<uint32_t, std::vector<ImageId>> SequenceOfDrives(
    const ImageManifest& manifest);

/// Those of these images that have a finite capture time, in the same order.
[[nodiscard]] std::vector<ImageId> TimedAmong(const ImageManifest& manifest,
                                              std::span<const ImageId> images);

}  // namespace orbweave
