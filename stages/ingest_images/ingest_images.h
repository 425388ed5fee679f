// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/io/images/image_sources.h"
#include "core/scene/image_manifest.h"
#include "stages/ingest_images/ingest_options.h"

namespace orbweave {

/// Decides which sources take part and what is known of each: drops files with a problem, images
/// that are not 2:1 (within a pixel) and byte-for-byte duplicates, each with its reason; numbers
/// the rest in natural name order; joins GNSS rows by full name, else base name, else stem (where
/// unique), else EXIF; puts the origin of the east-north-up frame at the rounded median position.
/// Mixed sizes are allowed. For times and drives see assign_drives.h. GNSS rows
/// without an image, images without a position, and masks of other proportions than their
/// image (then not used) become warnings; so does a direction that nobody measured
/// (DropSharedAngles). InvalidArgument: nothing is left (with the first
/// reasons), or the table is wrong. FailedPrecondition: altitudes are counted from a geoid whose
/// grid is not installed.
[[nodiscard]] absl::StatusOr<ImageManifest> IngestImages(const ImageSources& sources,
                                                         const IngestOptions& options,
                                                         const StageContext& context);

}  // namespace orbweave
