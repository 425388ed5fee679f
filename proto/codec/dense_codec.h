// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/artifacts/dense_records.h"
#include "core/base/status.h"
#include "core/dense/depth_map.h"

/// What the dense stages hand on. All decoders: DataLoss where bytes are no message, arrays
/// do not match or values are none.

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeViewRecipe(const ViewRecipe& recipe);
[[nodiscard]] absl::StatusOr<ViewRecipe> DecodeViewRecipe(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeChosenSources(const ChosenSources& chosen);
[[nodiscard]] absl::StatusOr<ChosenSources> DecodeChosenSources(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeDepthRecipe(const DepthRecipe& recipe);
[[nodiscard]] absl::StatusOr<DepthRecipe> DecodeDepthRecipe(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeDensePlan(const DensePlan& plan);
[[nodiscard]] absl::StatusOr<DensePlan> DecodeDensePlan(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeCheckRecipe(const CheckRecipe& recipe);
[[nodiscard]] absl::StatusOr<CheckRecipe> DecodeCheckRecipe(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeFuseRecipe(const FuseRecipe& recipe);
[[nodiscard]] absl::StatusOr<FuseRecipe> DecodeFuseRecipe(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeTileRuns(const TileRuns& runs);
[[nodiscard]] absl::StatusOr<TileRuns> DecodeTileRuns(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeTileRecipe(const TileRecipe& recipe);
[[nodiscard]] absl::StatusOr<TileRecipe> DecodeTileRecipe(std::string_view bytes);

}  // namespace orbweave
