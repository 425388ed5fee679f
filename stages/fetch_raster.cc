// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/fetch_raster.h"

#include <utility>

#include "core/base/status.h"
#include "core/dense/grey_panorama.h"
#include "stages/get_optional.h"

namespace orbweave {

absl::StatusOr<FetchedRaster> FetchRaster(const PanoramaFile& file,
                                          bool mask_ignores_white,
                                          int width_px,
                                          BlobAccess& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string image, blobs.Get(file.content));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string mask, GetOptional(file.mask, blobs));
  absl::StatusOr<DecodedRaster> raster =
      DecodeRaster(image, mask, mask_ignores_white, file.camera, width_px);
  FetchedRaster fetched;
  if (raster.ok()) {
    fetched.raster = *std::move(raster);
  } else {
    fetched.problem = std::string(raster.status().message());
  }
  return fetched;
}

PanoramaRaster ViewOf(const DecodedRaster& raster) {
  return {.width_px = raster.camera.width_px,
          .height_px = raster.camera.height_px,
          .channels = 3,
          .pixels = raster.rgb,
          .ignored = raster.ignored};
}

absl::StatusOr<FetchedGrey> FetchGrey(const PanoramaFile& file,
                                      bool mask_ignores_white,
                                      int width_px,
                                      BlobAccess& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(FetchedRaster fetched,
                            FetchRaster(file, mask_ignores_white, width_px, blobs));
  if (!fetched.problem.empty()) return FetchedGrey{.problem = fetched.problem};
  return FetchedGrey{.camera = fetched.raster.camera,
                     .levels = GreyLevelsOf(ViewOf(fetched.raster)),
                     .ignored = std::move(fetched.raster.ignored)};
}

PanoramaRaster ViewOf(const FetchedGrey& grey) {
  return {.width_px = grey.camera.width_px,
          .height_px = grey.camera.height_px,
          .channels = 1,
          .pixels = grey.levels,
          .ignored = grey.ignored};
}

}  // namespace orbweave
