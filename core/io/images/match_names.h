// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace orbweave {

/// For every image the index of the table row that means it: equal names first, then equal but for
/// upper and lower case, then equal base names ("b.jpg" for "a/b.jpg"), then equal stems ("b" for
/// "a/b.jpg"), each only where it is unique on both sides among what is left.
[[nodiscard]] std::vector<std::optional<size_t>> MatchNames(
    const std::vector<std::string>& image_names, const std::vector<std::string>& row_names);

}  // namespace orbweave
