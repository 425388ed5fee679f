// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace orbweave {

/// Where an image lies, by its name: "day1/" of "day1/0001.jpg", "" of "0001.jpg".
[[nodiscard]] inline std::string_view FolderOf(std::string_view name) {
  return name.substr(0, name.rfind('/') + 1);
}

}  // namespace orbweave
