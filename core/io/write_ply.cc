// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/write_ply.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/io/byte_stream.h"

namespace orbweave {
namespace {

/// As long for every count: a comment fills up what shorter numbers leave.
std::string HeaderFor(uint64_t num_points) {
  constexpr size_t kDigits = 20;
  const std::string count = absl::StrCat(num_points);
  return absl::StrCat(
      "ply\nformat binary_little_endian 1.0\ncomment orbweave",
      std::string(kDigits - count.size(), '.'),
      "\nelement vertex ",
      count,
      "\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n");
}

}  // namespace

PlyWriter::PlyWriter(std::string path) : file_(std::move(path)) { file_.Append(HeaderFor(0)); }

void PlyWriter::Add(const Track& track) {
  ByteWriter out;
  const Eigen::Vector3d& X = track.point_in_world;
  out.Put(X.x()).Put(X.y()).Put(X.z()).Put(track.color.r).Put(track.color.g).Put(track.color.b);
  file_.Append(out.Take());
  ++num_points_;
}

absl::Status PlyWriter::Finish() { return file_.CommitWithHead(HeaderFor(num_points_)); }

}  // namespace orbweave
