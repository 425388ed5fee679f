// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "absl/status/status.h"

namespace orbweave {

/// Whether the compressed data of a JPEG decode from the first block to the last. Decoders paint
/// what is damaged or missing in grey or noise, however whole the file looks: a picture cut in half
/// with an end marker behind it has half a panorama of grey. Here every block is decoded (at an
/// eighth of the size, so that little more than the entropy decoding is done) and libjpeg's
/// warnings are read. InvalidArgument with libjpeg's words for data that end early, codes that do
/// not exist, lost restart markers, and more than a hundredth of the file that belongs to nothing.
/// Remarks on what does not change pixels (a few bytes too many, an unknown version) pass.
[[nodiscard]] absl::Status CheckJpegData(std::string_view encoded);

}  // namespace orbweave
