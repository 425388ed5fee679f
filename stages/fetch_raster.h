// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/artifacts/dense_records.h"
#include "core/dense/panorama_raster.h"
#include "core/features/decode_raster.h"
#include "core/pipeline/blob_access.h"

namespace orbweave {

struct FetchedRaster {
  DecodedRaster raster{};
  std::string problem{};  ///< why it cannot be used, for people; empty when it can
};

/// A panorama and its mask, decoded and brought to a width (DecodeRaster). Errors are those of the
/// blobs.
[[nodiscard]] absl::StatusOr<FetchedRaster> FetchRaster(const PanoramaFile& file,
                                                        bool mask_ignores_white,
                                                        int width_px,
                                                        BlobAccess& blobs);

[[nodiscard]] PanoramaRaster ViewOf(const DecodedRaster& raster);

/// A panorama without its colours, which take two thirds of it.
struct FetchedGrey {
  EquirectangularCamera camera{};
  std::vector<uint8_t> levels{};
  std::vector<uint8_t> ignored{};
  std::string problem{};  ///< why it cannot be used, for people; empty when it can
};

/// The same of FetchRaster, as GreyLevelsOf has it.
[[nodiscard]] absl::StatusOr<FetchedGrey> FetchGrey(const PanoramaFile& file,
                                                    bool mask_ignores_white,
                                                    int width_px,
                                                    BlobAccess& blobs);

[[nodiscard]] PanoramaRaster ViewOf(const FetchedGrey& grey);

}  // namespace orbweave
