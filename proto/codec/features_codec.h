// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/artifacts/recipes.h"
#include "core/base/status.h"
#include "core/scene/features.h"

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeFeatures(const Features& features);
/// DataLoss when the bytes are not whole features: arrays of one length,
/// keypoints in the image, sigmas that are angles.
[[nodiscard]] absl::StatusOr<Features> DecodeFeatures(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodePlaceSample(const PlaceSample& sample);
[[nodiscard]] absl::StatusOr<PlaceSample> DecodePlaceSample(std::string_view bytes);

}  // namespace orbweave
