// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"
#include "core/dense/top_view.h"

namespace orbweave {

/// The bytes of a PNG file, transparent where nothing is seen; the picture is not empty.
[[nodiscard]] absl::StatusOr<std::string> DrawTopView(const TopPicture& picture);

}  // namespace orbweave
