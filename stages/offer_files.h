// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/io/image_sources.h"
#include "core/pipeline/blob_depot.h"

namespace orbweave {

/// Makes every usable file and mask known that the depot does not have yet: linked where it can
/// read them itself, uploaded where it cannot. DataLoss: a file changed since it was listed.
[[nodiscard]] absl::Status OfferFiles(BlobDepot& depot,
                                      const ImageSources& sources,
                                      const StageContext& context);

}  // namespace orbweave
