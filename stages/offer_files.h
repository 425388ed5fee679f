// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/io/images/scan_image_folder.h"
#include "core/pipeline/blob_depot.h"

namespace orbweave {

/// Makes every usable file and mask, which were found at `places`, known that the depot does not
/// have yet: linked where it can read them itself, uploaded where it cannot. DataLoss: a file
/// changed since it was listed. Reports "files"; once one was uploaded, "files, some sent".
[[nodiscard]] absl::Status OfferFiles(BlobDepot& depot,
                                      const ImageSources& sources,
                                      const ImagePlaces& places,
                                      const StageContext& context);

}  // namespace orbweave
