// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/digest.h"
#include "core/io/images/image_metadata.h"

namespace orbweave {

/// One file that may become an image of the job.
struct SourceImage {
  std::string name{};  ///< relative to the image folder, '/' as separator
  std::string path{};  ///< absolute; empty when the job starts from a database
  Digest content{};    ///< of the file; zero when the job starts from a database
  uint64_t size_bytes = 0;
  ImageMetadata metadata{};
  std::string mask_path{};  ///< absolute; empty: no mask
  Digest mask{};
  int mask_width_px = 0;  ///< 0 when the mask's header cannot be read
  int mask_height_px = 0;
  /// Camera centre in a local metric frame given from outside (a database's Cartesian prior), and
  /// its standard deviations (horizontal, vertical; metres).
  std::optional<Eigen::Vector3d> position_in_local{};
  std::optional<Eigen::Vector2d> position_sigma_m{};
  /// Why it cannot be used ("is a text file named .jpg"); empty when all is well.
  std::string problem{};
};

/// Everything IngestImages looks at: the folder's files in natural name order and the GNSS table's
/// text.
struct ImageSources {
  std::vector<SourceImage> images{};
  bool mask_ignores_white = true;       ///< false: black pixels are ignored (COLMAP's convention)
  std::string gnss_text{};              ///< content of the GNSS table; empty: none
  std::string gnss_name{};              ///< its file name, for messages
  std::vector<std::string> warnings{};  ///< e.g. masks without an image
};

}  // namespace orbweave
