// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Images of one drive one after the other.
struct DriveSequence {
  uint32_t drive = 0;
  std::vector<ImageId> images{};
  /// Neither times nor names tell the order; it is that of the way which the places make
  /// (OrderIfInNone), and in which direction the carrier went is not known.
  bool is_by_place = false;
};

/// Of those images whose places in a model are given, drive by drive, in the order in which they
/// were taken (SequenceOfDrives); by place where no image of a drive has a time and the names are
/// in no order (VoteOnOrder): what neighbours have in common, such as errors of GNSS, shows among
/// neighbours only. Drives without such images are left out.
[[nodiscard]] std::vector<DriveSequence> DriveSequences(
    const std::map<ImageId, Eigen::Vector3d>& places, const ImageManifest& manifest);

}  // namespace orbweave
