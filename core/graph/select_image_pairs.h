// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/pair_options.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Which two panoramas may see the same. The union of
///   - a window along the sequence of each drive (SequenceOfDrives),
///   - for an image of which neither position nor time is known, a window along the names of its
///     folder: it may be of the drive of any,
///   - each image's nearest GNSS neighbours within a radius, by horizontal distance, and where the
///     street is thinly covered the nearest few beyond it, as far as look-alikes are believed,
///   - `similar` (per image the most similar others, best first; may be empty), without those that
///     GNSS puts too far apart (MayBeNear);
/// or every two images of a small job. A wrong GNSS position adds pairs and takes look-alikes away;
/// sequence pairs it leaves alone. Sorted, without repetition.
[[nodiscard]] std::vector<ImagePair> SelectImagePairs(
    const ImageManifest& manifest,
    const std::vector<std::vector<ImageId>>& similar,
    const PairOptions& options);

}  // namespace orbweave
