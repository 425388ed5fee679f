// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace orbweave {

/// Whether a file of this name or path is taken for an image (jpg jpeg png tif tiff bmp webp ppm
/// pgm, in any case).
[[nodiscard]] bool IsCalledLikeAnImage(std::string_view path);

/// Every file below `folder` that is called like an image, as path relative to it with '/', in
/// natural order. Symbolic links are followed, each folder is visited once; names that begin with a
/// dot and the folder `except` (may be empty) are skipped. NotFound: no such folder;
/// PermissionDenied: it or a folder below cannot be listed.
[[nodiscard]] absl::StatusOr<std::vector<std::string>> ListImageFiles(const std::string& folder,
                                                                      const std::string& except);

}  // namespace orbweave
