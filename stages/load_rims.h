// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/base/digest.h"
#include "core/base/status.h"
#include "core/merging/alignment/submodel.h"
#include "core/pipeline/blob_access.h"

namespace orbweave {

/// The submodels that boundaries of clusters hold, by cluster and then by size. DataLoss: the
/// clusters are not in order.
[[nodiscard]] absl::StatusOr<std::vector<Submodel>> LoadBoundaries(
    std::span<const Digest> boundaries, BlobAccess& blobs);

}  // namespace orbweave
