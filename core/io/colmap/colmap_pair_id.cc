// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/colmap_pair_id.h"

#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr uint64_t kMaxNumImages = 2147483647;

}  // namespace

uint64_t PairIdFromImageIds(uint32_t a, uint32_t b) {
  ORBWEAVE_CHECK(a < b && b < kMaxNumImages);
  return kMaxNumImages * a + b;
}

std::pair<uint32_t, uint32_t> ImageIdsFromPairId(uint64_t pair_id) {
  const uint64_t b = pair_id % kMaxNumImages;
  return {static_cast<uint32_t>((pair_id - b) / kMaxNumImages), static_cast<uint32_t>(b)};
}

}  // namespace orbweave
