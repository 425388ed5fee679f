// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "core/io/file.h"
#include "core/scene/surface_point.h"

namespace orbweave {

/// Points of the dense cloud as a binary PLY file, little-endian, written piece by piece: double x
/// y z (world, metres), float nx ny nz, uchar red green blue, float sigma (metres), uchar views;
/// 44 bytes a point.
class DensePlyWriter {
 public:
  explicit DensePlyWriter(std::string path);

  void Add(std::span<const SurfacePoint> points);
  /// The file takes its place. Codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Finish();

 private:
  AtomicFile file_;
  uint64_t num_points_ = 0;
};

}  // namespace orbweave
