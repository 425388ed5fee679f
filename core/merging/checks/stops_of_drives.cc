// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/stops_of_drives.h"

#include "core/scene/captures_along.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {

std::vector<StopsOfDrive> StopsOfDrives(const std::map<ImageId, RegisteredImage>& images,
                                        const ImageManifest& manifest) {
  std::vector<StopsOfDrive> drives;
  for (const auto& [drive, ids] : SequenceOfDrives(manifest)) {
    const std::vector<uint32_t> captures = CapturesAlong(manifest, ids);
    StopsOfDrive& of_drive = drives.emplace_back();
    for (size_t i = 0; i < ids.size(); ++i) {
      const auto found = images.find(ids[i]);
      if (found == images.end() || found->second.loose) continue;
      of_drive.images.push_back(ids[i]);
      of_drive.stops.push_back({captures[i], found->second.cam_from_world.Centre()});
    }
  }
  return drives;
}

}  // namespace orbweave
