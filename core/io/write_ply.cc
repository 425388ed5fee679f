// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/write_ply.h"

#include "absl/strings/str_cat.h"
#include "core/io/byte_stream.h"
#include "core/io/file.h"

namespace orbweave {

std::string PlyFromReconstruction(const Reconstruction& reconstruction) {
  ByteWriter out;
  out.PutText(
      absl::StrCat("ply\nformat binary_little_endian 1.0\nelement vertex ",
                   reconstruction.tracks.size(),
                   "\nproperty double x\nproperty double y\nproperty double z\n"
                   "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"));
  for (const Track& track : reconstruction.tracks) {
    const Eigen::Vector3d& X = track.point_in_world;
    out.Put(X.x()).Put(X.y()).Put(X.z()).Put(track.color.r).Put(track.color.g).Put(track.color.b);
  }
  return out.Take();
}

absl::Status WritePly(const Reconstruction& reconstruction, const std::string& path) {
  return WriteFileAtomically(path, PlyFromReconstruction(reconstruction));
}

}  // namespace orbweave
