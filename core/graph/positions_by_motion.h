// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

struct PositionByMotion {
  PosePrior prior{};
  bool is_of_drive = false;  ///< not of one measurement alone: the drive's others tell it too
};

/// What is known of every image's position when one remembers that a carrier cannot jump: per
/// image of the manifest its prior, in which position and sigmas are those of a smoothed motion
/// (SmoothMotion) wherever capture times tell how a drive went on. Between houses single positions
/// are 30 m off; the drive through the others is not. Images without a position get one from those
/// around them (not worse than 50 m). Sigmas are those of single positions at least, as what
/// smoothed ones are off neighbours share.
///
/// Of each drive, horizontally and in height for itself: its sigmas are as many times those
/// stated as they prove (reweighted, Geman-McClure, so that single ones may be wrong): a tenth at
/// least, or 1 for fewer than 20. Times in whole seconds tell the place at speed v to v / sqrt(12):
/// positions that are better than that stay about as they are, and count as good as their errors
/// prove beside those of times.
///
/// Priors stay as they are of images without a time, and where a drive has fewer than five
/// positions at known times, speeds beyond 60 m/s, positions ten times worse than stated, or three
/// tenths of them off what the others say by four sigmas: then times or order are not those of the
/// drive. Linear in the images but for sorting.
[[nodiscard]] std::vector<PositionByMotion> PositionsByMotion(const ImageManifest& manifest);

}  // namespace orbweave
