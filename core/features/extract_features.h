// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "core/base/stage_context.h"
#include "core/features/extract_options.h"
#include "core/scene/features.h"

namespace orbweave {

struct ExtractInput {
  std::string_view name{};           ///< for messages
  std::string_view encoded_image{};  ///< JPEG, PNG, TIFF, ... as read from the file
  std::string_view encoded_mask{};   ///< empty: no mask
  bool mask_ignores_white = true;    ///< false: black pixels are ignored (COLMAP's convention)
  bool wants_facades = false;        ///< those of facade views, too (AppendFacadeFeatures)
};

/// SIFT of one equirectangular panorama that continues across the seam and the poles: RootSIFT
/// descriptors, spatially balanced top-k, colours, angular sigmas. Memory beside the pixels
/// themselves grows with the width of the panorama alone. An image or mask that cannot be used (not
/// decodable, not 2:1, mask of other proportions) is a value: Features with `problem` set.
/// Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<Features> ExtractFeatures(const ExtractInput& input,
                                                       const ExtractOptions& options,
                                                       const StageContext& context);

}  // namespace orbweave
