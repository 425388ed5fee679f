// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// The kinds of encoded images that a job takes.
enum class ImageKind { kUnknown, kJpeg, kPng, kTiff, kBmp, kWebp, kPnm };

/// What an encoded image says of itself before a single pixel is decoded.
struct ImageHeader {
  int width_px = 0;
  int height_px = 0;
  /// False when the file ends before the image does (JPEG's EOI, PNG's IEND; BMP, WebP and PNM by
  /// their lengths): decoders paint the rest grey without a word. True for TIFF, which does not
  /// tell.
  bool complete = true;
};

/// The header of a binary PPM or PGM: "P6 # comment 640 320 255", one blank, and rows of 3 (P5: 1)
/// samples of 1 or 2 bytes. Fields that are missing are 0.
struct PnmHeader {
  int width_px = 0;
  int height_px = 0;
  int largest = 0;       ///< value of a sample
  int channels = 0;      ///< 3, or 1
  size_t pixels_at = 0;  ///< of the first byte of the first row

  /// Of all rows.
  [[nodiscard]] size_t NumBytes() const;
};
[[nodiscard]] PnmHeader ReadPnmHeader(std::string_view encoded);

/// The kind by the first bytes, whatever the file is called. PNM is binary PPM or PGM (P6, P5).
[[nodiscard]] ImageKind IdentifyImage(std::string_view encoded);

/// Reads the header of a file of a known kind. InvalidArgument when the bytes are of none or end
/// within the header.
[[nodiscard]] absl::StatusOr<ImageHeader> ReadImageHeader(std::string_view encoded);

}  // namespace orbweave
