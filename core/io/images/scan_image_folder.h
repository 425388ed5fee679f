// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/io/images/file_place.h"
#include "core/io/images/image_sources.h"

namespace orbweave {

struct ScanRequest {
  std::string image_folder{};  ///< or s3://BUCKET/PREFIX, for OpenImagePlaces; so the others
  /// Empty: no masks. A folder of masks, which are found by their names (MaskNames), or a file that
  /// is called like an image: the mask of all of them.
  std::string masks{};
  bool mask_ignores_white = true;
  std::string gnss_table{};  ///< path of the GNSS table; empty: none
  std::string store_keys{};  ///< file of the keys of object stores; empty: in the environment
};

/// The places of a request.
struct ImagePlaces {
  std::unique_ptr<FilePlace> images{};
  std::unique_ptr<FilePlace> masks{};       ///< null: no masks
  std::string mask_for_all{};               ///< there, of every image; empty: by names (MaskNames)
  std::optional<std::string> gnss_bytes{};  ///< of a table that is no file of this machine

  /// How many files are best read at a time, whatever the number of processors.
  [[nodiscard]] int NumReaders() const {
    const bool is_elsewhere = images->IsElsewhere() || (masks && masks->IsElsewhere());
    return is_elsewhere ? 8 : 1;
  }
};

/// Sets where masks are that lie at a path of this machine (ScanRequest::masks).
void PlaceMasks(const std::string& path, ImagePlaces& places);

/// The places of a request whose paths are all of this machine.
[[nodiscard]] ImagePlaces FoldersOf(const ScanRequest& request);

/// Lists the image files (jpg jpeg png tif tiff bmp webp ppm pgm, in any case) below a folder,
/// following symbolic links, in natural name order, and reads each once: digest, dimensions,
/// metadata, mask. A file that cannot be used, one whose name is not UTF-8 too, is listed with its
/// `problem`. NotFound: the folder is
/// missing or holds no image, or the mask folder or GNSS table is missing; each message says what
/// to do. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<ImageSources> ScanImageFolder(const ScanRequest& request,
                                                           const StageContext& context);

/// The same for files of any places, of which those that are listed are called like images. Errors
/// of the places, where one says that it cannot be read.
[[nodiscard]] absl::StatusOr<ImageSources> ScanImagePlaces(const ImagePlaces& places,
                                                           const ScanRequest& request,
                                                           const StageContext& context);

/// Reads the GNSS table at `path` into `sources`. Codes of ReadTextFile.
[[nodiscard]] absl::Status ReadGnssFile(const std::string& path, ImageSources& sources);

}  // namespace orbweave
