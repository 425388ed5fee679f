// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/graph/pair_options.h"
#include "core/scene/image_manifest.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// Removes given pairs (of a database) that an image job would not have tried: two panoramas that
/// lie too far apart by GNSS (MayBeNear) and are not within pairs.sequence_window of each other
/// along a drive, where a wrong position must not cut the chain. One warning counts and names them.
/// The rest stays in its order.
void SetAsideFarPairs(const PairOptions& options,
                      ImageManifest& manifest,
                      std::vector<TwoViewGeometry>& pairs);

}  // namespace orbweave
