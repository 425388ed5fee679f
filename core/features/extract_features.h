// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/scene/features.h"

namespace orbweave {

struct ExtractOptions {
  int max_features = 10000;
  double max_latitude_deg = 65.0;
  double contrast_threshold = 0.003;
  double edge_threshold = 10.0;
  int tile_size_px = 1024;
  int max_image_width_px = 32768;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("max_features",
          self.max_features,
          "keypoints kept per panorama, spread over the sphere",
          Range{64, 65536});
    visit("max_latitude_deg",
          self.max_latitude_deg,
          "keypoints further from the horizon are not used",
          Range{5, 90});
    visit("contrast_threshold",
          self.contrast_threshold,
          "weakest SIFT contrast; the best max_features above it are kept",
          Range{0.001, 0.2});
    visit("edge_threshold", self.edge_threshold, "SIFT edge threshold", Range{2, 50});
    visit("tile_size_px",
          self.tile_size_px,
          "rows and columns worked on at a time: bounds the memory",
          Range{64, 16384});
    visit("max_image_width_px",
          self.max_image_width_px,
          "wider images are refused before decoding",
          Range{64, 65536});
  }
};

struct ExtractInput {
  std::string_view name{};           ///< for messages
  std::string_view encoded_image{};  ///< JPEG, PNG, TIFF, ... as read from the file
  std::string_view encoded_mask{};   ///< empty: no mask
  bool mask_ignores_white = true;    ///< false: black pixels are ignored (COLMAP's convention)
};

/// Seam-wrapped SIFT of one equirectangular panorama: RootSIFT descriptors, spatially balanced
/// top-k, colours, angular sigmas. Works in overlapping tiles that continue across the seam and the
/// poles, so memory beside the pixels themselves does not grow with the panorama. An image or mask
/// that cannot be used (not decodable, not 2:1, mask of other proportions) is a value: Features
/// with `problem` set. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<Features> ExtractFeatures(const ExtractInput& input,
                                                       const ExtractOptions& options,
                                                       const StageContext& context);

}  // namespace orbweave
