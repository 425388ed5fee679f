// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace orbweave {

/// What `orbweave inspect` found.
struct Inspection {
  std::string text{};       ///< lines for a terminal
  std::string png{};        ///< the picture
  std::string file_name{};  ///< for the picture, where nobody chose another
};

}  // namespace orbweave
