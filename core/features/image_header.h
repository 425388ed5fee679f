// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// What an encoded image says of itself before a single pixel is decoded.
struct ImageHeader {
  int width_px = 0;
  int height_px = 0;
  /// False when the file ends before its end marker (JPEG's EOI, PNG's IEND): decoders paint the
  /// rest grey without a word. True for formats without such a marker.
  bool complete = true;
};

/// Reads the header of a JPEG, PNG, TIFF, BMP or WebP file. InvalidArgument when the bytes are none
/// of these or end within the header.
[[nodiscard]] absl::StatusOr<ImageHeader> ReadImageHeader(std::string_view encoded);

}  // namespace orbweave
