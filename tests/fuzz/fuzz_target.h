// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace orbweave {

/// Takes any bytes, ends the process when a law is broken.
using FuzzTarget = void (*)(const uint8_t* data, size_t size);

/// The targets of this program by name.
inline std::map<std::string, FuzzTarget>& FuzzTargets() {
  static std::map<std::string, FuzzTarget> targets;
  return targets;
}

}  // namespace orbweave

/// FUZZ_TARGET(name) { ... } is a target, whose body has the bytes as `data` and `size`: the only
/// one of a program of libFuzzer (ORBWEAVE_LIBFUZZER), else one of those that the program `replay`
/// knows.
#ifdef ORBWEAVE_LIBFUZZER
#define FUZZ_TARGET(name)                                                   \
  static void Fuzz_##name(const uint8_t* data, size_t size);                \
  extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) { \
    Fuzz_##name(data, size);                                                \
    return 0;                                                               \
  }                                                                         \
  static void Fuzz_##name(const uint8_t* data, size_t size)
#else
#define FUZZ_TARGET(name)                                          \
  static void Fuzz_##name(const uint8_t* data, size_t size);       \
  [[maybe_unused]] static const bool is_known_##name =             \
      orbweave::FuzzTargets().emplace(#name, &Fuzz_##name).second; \
  static void Fuzz_##name(const uint8_t* data, size_t size)
#endif
