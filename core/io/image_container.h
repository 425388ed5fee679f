// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string_view>

#include "absl/status/status.h"

namespace orbweave {

enum class ImageKind { kUnknown, kJpeg, kPng, kTiff, kBmp, kWebp, kPnm };

/// The kind by the first bytes, whatever the file is called.
[[nodiscard]] ImageKind IdentifyImage(std::string_view encoded);

/// Whether the data reach the end of the image: JPEG up to the EOI marker after the scan, PNG up to
/// IEND, BMP and WebP as long as they say. Decoders fill a missing rest with grey without a word,
/// so this is asked before. InvalidArgument "truncated: ..." otherwise. Kinds that do not tell
/// (TIFF, PNM) pass.
[[nodiscard]] absl::Status CheckComplete(std::string_view encoded);

}  // namespace orbweave
