// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "core/base/status.h"
#include "core/scene/carrier.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

using FetchFeatures = std::function<absl::StatusOr<Features>(ImageId)>;

/// What goes along with the camera of each drive that shows it (FindCarrier), by at most 24
/// panoramas with a position, evenly chosen along its sequence. None of drives without positions,
/// whose panoramas might all show one place. Errors of `fetch`.
[[nodiscard]] absl::StatusOr<std::vector<Carrier>> FindCarriers(const ImageManifest& manifest,
                                                                const FetchFeatures& fetch);

}  // namespace orbweave
