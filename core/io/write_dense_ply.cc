// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/write_dense_ply.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/io/byte_stream.h"

namespace orbweave {
namespace {

/// As long for every count: a comment fills up what shorter numbers leave.
std::string HeaderFor(uint64_t num_points) {
  constexpr size_t kDigits = 20;
  const std::string count = absl::StrCat(num_points);
  return absl::StrCat("ply\nformat binary_little_endian 1.0\ncomment orbweave",
                      std::string(kDigits - count.size(), '.'),
                      "\nelement vertex ",
                      count,
                      "\nproperty double x\nproperty double y\nproperty double z\n"
                      "property float nx\nproperty float ny\nproperty float nz\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "property float sigma\nproperty uchar views\nend_header\n");
}

}  // namespace

DensePlyWriter::DensePlyWriter(std::string path) : file_(std::move(path)) {
  file_.Append(HeaderFor(0));
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

absl::Status DensePlyWriter::Finish() { return file_.CommitWithHead(HeaderFor(num_points_)); }

}  // namespace orbweave
