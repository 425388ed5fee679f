// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>

namespace orbweave {

/// COLMAP's number of an image pair: 2147483647 * a + b for image ids a < b; and back.
[[nodiscard]] uint64_t PairIdFromImageIds(uint32_t a, uint32_t b);
[[nodiscard]] std::pair<uint32_t, uint32_t> ImageIdsFromPairId(uint64_t pair_id);

}  // namespace orbweave
