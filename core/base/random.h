// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/base/digest.h"

namespace orbweave {

/// SplitMix64: small, seeded, the same numbers on every machine and library.
/// Steele, Lea, Flood: Fast splittable pseudorandom number generators, OOPSLA 2014.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  /// Seeds from text, e.g. the names of an image pair.
  explicit Random(std::string_view text) : state_(DigestOf(text).ToSeed()) {}

  uint64_t Next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1).
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// Uniform in {0, ..., n-1}; n > 0.
  uint32_t Index(uint32_t n) { return static_cast<uint32_t>(((Next() >> 32) * n) >> 32); }
  /// Standard normal, Box-Muller.
  double Normal() {
    const double u = 1.0 - Uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * Uniform());
  }

 private:
  uint64_t state_;
};

}  // namespace orbweave
