// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "core/base/status.h"
#include "core/synthetic/corridor_options.h"

namespace orbweave {

struct CorridorSize {
  size_t panoramas = 0;
  size_t pairs = 0;
};

/// Makes a corridor and writes corridor.db (keypoints and matches), gnss.csv and truth.csv into
/// `folder`. Codes of EnsureWritableFolder and WriteFileAtomically.
[[nodiscard]] absl::StatusOr<CorridorSize> WriteCorridor(const CorridorOptions& options,
                                                         const std::string& folder);

}  // namespace orbweave
