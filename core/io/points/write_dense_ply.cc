// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/points/write_dense_ply.h"

#include <string_view>
#include <utility>

#include "core/io/byte_stream.h"
#include "core/io/points/ply_head.h"

namespace orbweave {
namespace {

constexpr std::string_view kProperties =
    "property float nx\nproperty float ny\nproperty float nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "property float sigma\nproperty uchar views\n";

}  // namespace

DensePlyWriter::DensePlyWriter(std::string path) : file_(std::move(path)) {
  file_.Append(PlyHead(0, kProperties));
}

void DensePlyWriter::Add(std::span<const SurfacePoint> points) {
  ByteWriter out;
  for (const SurfacePoint& point : points) {
    const Eigen::Vector3d& X = point.position_in_world;
    const Eigen::Vector3f& n = point.normal_in_world;
    out.Put(X.x()).Put(X.y()).Put(X.z()).Put(n.x()).Put(n.y()).Put(n.z());
    out.Put(point.color.r).Put(point.color.g).Put(point.color.b);
    out.Put(point.sigma_m).Put(point.views);
  }
  file_.Append(out.Take());
  num_points_ += points.size();
}

absl::Status DensePlyWriter::Finish() {
  return file_.CommitWithHead(PlyHead(num_points_, kProperties));
}

}  // namespace orbweave
