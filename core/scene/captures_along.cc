// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/captures_along.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>

namespace orbweave {
namespace {

constexpr std::string_view kDigits = "0123456789";
/// Of neighbours, how many differ by one capture.
constexpr double kMostOften = 0.5;
/// Nobody asks how many more than that are missing.
constexpr int64_t kMostCaptures = 1000;

/// 0 where there is none, or none that counts anything.
int64_t NumberIn(std::string_view name) {
  name.remove_prefix(name.rfind('/') + 1);
  name = name.substr(0, name.rfind('.'));
  const size_t last = name.find_last_of(kDigits);
  if (last == std::string_view::npos) return 0;
  name = name.substr(0, last + 1);
  name.remove_prefix(name.find_last_not_of(kDigits) + 1);
  int64_t number = 0;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return number;
}

std::vector<int64_t> DifferencesOf(const ImageManifest& manifest,
                                   std::span<const ImageId> sequence) {
  std::vector<int64_t> differences;
  for (size_t i = 0; i + 1 < sequence.size(); ++i)
    differences.push_back(NumberIn(manifest.At(sequence[i + 1]).name) -
                          NumberIn(manifest.At(sequence[i]).name));
  return differences;
}

/// 0 where numbers count nothing.
int64_t OneCapture(std::span<const int64_t> differences) {
  std::map<int64_t, size_t> counts;
  for (const int64_t difference : differences) ++counts[difference];
  const auto most = std::ranges::max_element(counts, {}, [](const auto& of) { return of.second; });
  if (most == counts.end() || most->first <= 0) return 0;
  const auto needed = kMostOften * static_cast<double>(differences.size());
  return static_cast<double>(most->second) >= needed ? most->first : 0;
}

}  // namespace

std::vector<uint32_t> CapturesAlong(const ImageManifest& manifest,
                                    std::span<const ImageId> sequence) {
  std::vector<uint32_t> captures(sequence.size(), 0);
  const std::vector<int64_t> differences = DifferencesOf(manifest, sequence);
  const int64_t one = OneCapture(differences);
  for (size_t i = 0; i < differences.size(); ++i) {
    const bool counts = one > 0 && differences[i] > 0 && differences[i] % one == 0;
    const int64_t steps = counts ? std::min(differences[i] / one, kMostCaptures) : 1;
    captures[i + 1] = captures[i] + static_cast<uint32_t>(steps);
  }
  return captures;
}

}  // namespace orbweave
