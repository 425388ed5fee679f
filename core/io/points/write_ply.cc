// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/points/write_ply.h"

#include <string_view>
#include <utility>

#include "core/io/byte_stream.h"
#include "core/io/points/ply_head.h"

namespace orbweave {
namespace {

constexpr std::string_view kProperties =
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";

}  // namespace

PlyWriter::PlyWriter(std::string path) : file_(std::move(path)) {
  file_.Append(PlyHead(0, kProperties));
}

void PlyWriter::Add(const Track& track) {
  ByteWriter out;
  const Eigen::Vector3d& X = track.point_in_world;
  out.Put(X.x()).Put(X.y()).Put(X.z()).Put(track.color.r).Put(track.color.g).Put(track.color.b);
  file_.Append(out.Take());
  ++num_points_;
}

absl::Status PlyWriter::Finish() { return file_.CommitWithHead(PlyHead(num_points_, kProperties)); }

}  // namespace orbweave
