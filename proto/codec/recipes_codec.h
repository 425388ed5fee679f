// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/artifacts/recipes.h"
#include "core/base/status.h"

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeExtractRecipe(const ExtractRecipe& recipe);
[[nodiscard]] absl::StatusOr<ExtractRecipe> DecodeExtractRecipe(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeMatchRecipe(const MatchRecipe& recipe);
/// DataLoss: a pair out of order, or a pair or a carrier of an image the recipe does not list.
[[nodiscard]] absl::StatusOr<MatchRecipe> DecodeMatchRecipe(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeClusterRecipe(const ClusterRecipe& recipe);
/// DataLoss: the same; a shared image or a position of an image that it does not list.
[[nodiscard]] absl::StatusOr<ClusterRecipe> DecodeClusterRecipe(std::string_view bytes);

}  // namespace orbweave
