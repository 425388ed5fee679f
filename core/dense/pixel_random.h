// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/base/random.h"

namespace orbweave {

/// Random numbers that are a function of a seed, a pixel and a draw, so that the order in which
/// pixels are visited does not matter. SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
class PixelRandom {
 public:
  PixelRandom(uint64_t seed, uint64_t pixel, uint64_t draw)
      : state_(Mixed(seed ^ Mixed((draw << 44) ^ pixel))) {}

  /// Uniform in [0, 1), of 21 bits; three of a state.
  float Uniform() {
    if (left_ == 0) {
      state_ = Mixed(state_);
      bits_ = state_;
      left_ = 3;
    }
    --left_;
    const auto value = static_cast<float>(bits_ & 0x1FFFFF) * 0x1p-21F;
    bits_ >>= 21;
    return value;
  }
  /// Uniform in [-1, 1).
  float Signed() { return 2.0F * Uniform() - 1.0F; }

 private:
  static uint64_t Mixed(uint64_t z) { return Random(z).Next(); }

  uint64_t state_;
  uint64_t bits_ = 0;
  int left_ = 0;
};

}  // namespace orbweave
