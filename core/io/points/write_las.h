// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "core/io/file.h"
#include "core/scene/surface_point.h"

namespace orbweave {

/// What a LAS file says of itself.
struct LasDescription {
  /// Of the stored coordinates; a point near the data, a multiple of a millimetre.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  /// OGC well-known text (WKT 1) of the frame of the positions; empty: the file names none.
  std::string wkt{};
  uint16_t creation_day_of_year = 0;  ///< 1 ... 366; 0: not told
  uint16_t creation_year = 0;
};

/// Points of the dense cloud as LAS 1.4 (ASPRS, LAS specification 1.4 R15), point data format 7,
/// written piece by piece; counts and bounds enter the head at the end. Positions are taken as they
/// are, in the frame that `wkt` names, and stored in steps of 0.5 mm (kPositionQuantum_m of the
/// dense cloud) as far as 1,000 km from `offset`; colours are 16 bits wide (8 bits x 256). Extra
/// bytes: float `sigma` (metres), NormalX, NormalY, NormalZ (16 bits, scaled), `views`. Each point
/// is the only return, of class 0 (never classified). 47 bytes a point.
class LasWriter {
 public:
  LasWriter(std::string path, LasDescription description);

  void Add(std::span<const SurfacePoint> points);
  /// The file takes its place. InvalidArgument: a position that is not finite or too far from the
  /// offset, or too long a text; codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Finish();

 private:
  [[nodiscard]] std::string Head() const;

  std::string path_;
  LasDescription description_;
  AtomicFile file_;
  uint64_t num_points_ = 0;
  Eigen::Array3d low_;
  Eigen::Array3d high_;
  bool fits_ = true;
};

}  // namespace orbweave
