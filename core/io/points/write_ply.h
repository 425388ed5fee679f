// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "core/io/file.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// Points and colours as a binary PLY file (double positions), written one by one.
class PlyWriter {
 public:
  explicit PlyWriter(std::string path);

  void Add(const Track& track);
  /// Codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Finish();

 private:
  AtomicFile file_;
  uint64_t num_points_ = 0;
};

}  // namespace orbweave
