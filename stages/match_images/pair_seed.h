// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/base/digest.h"

namespace orbweave {

/// Seed of a pair by the Features of its two images: the same pair gives the same answer in any
/// task, and when it is looked at again.
[[nodiscard]] inline uint64_t PairSeed(const Digest& features_a, const Digest& features_b) {
  return DigestBuilder()
      .AddField(features_a.ToHex())
      .AddField(features_b.ToHex())
      .Finish()
      .ToSeed();
}

}  // namespace orbweave
