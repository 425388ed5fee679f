// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_length_faults.h"

#include <algorithm>
#include <map>
#include <utility>

namespace orbweave {
namespace {

constexpr double kFewestRays = 50.0;
constexpr uint32_t kFewestPairs = 3;
constexpr size_t kReach = 6;  // places from one image of a pair to the other

struct Sum {
  LengthAgreement agreement{};
  uint32_t pairs = 0;

  void Add(const LengthAgreement& pair) {
    agreement.Add(pair);
    pairs += pair.told > 0.0 ? 1 : 0;
  }
  [[nodiscard]] bool IsFault() const {
    return pairs >= kFewestPairs && agreement.told >= kFewestRays &&
           agreement.Share() < kMinAgreeingLengths;
  }
};

/// Where each image stands in its sequence.
struct Place {
  size_t sequence = 0;
  size_t position = 0;
};

std::map<ImageId, Place> PlacesOf(std::span<const std::vector<ImageId>> sequences) {
  std::map<ImageId, Place> places;
  for (size_t s = 0; s < sequences.size(); ++s) {
    for (size_t i = 0; i < sequences[s].size(); ++i) places[sequences[s][i]] = {s, i};
  }
  return places;
}

/// Of the gaps behind each position of each sequence.
std::vector<std::vector<Sum>> SumAcrossGaps(std::span<const PairLength> pairs,
                                            std::span<const std::vector<ImageId>> sequences) {
  std::vector<std::vector<Sum>> gaps;
  for (const std::vector<ImageId>& sequence : sequences) gaps.emplace_back(sequence.size());
  const std::map<ImageId, Place> places = PlacesOf(sequences);
  for (const PairLength& pair : pairs) {
    const auto a = places.find(pair.pair.a);
    const auto b = places.find(pair.pair.b);
    if (a == places.end() || b == places.end() || a->second.sequence != b->second.sequence)
      continue;
    const auto [first, last] = std::minmax(a->second.position, b->second.position);
    if (last - first > kReach) continue;
    for (size_t gap = first; gap < last; ++gap) gaps[a->second.sequence][gap].Add(pair.agreement);
  }
  return gaps;
}

}  // namespace

std::vector<LengthFault> FindLengthFaults(std::span<const PairLength> pairs,
                                          std::span<const std::vector<ImageId>> sequences) {
  std::map<ImageId, Sum> images;
  for (const PairLength& pair : pairs) {
    images[pair.pair.a].Add(pair.agreement);
    images[pair.pair.b].Add(pair.agreement);
  }
  std::vector<LengthFault> faults;
  for (const auto& [image, sum] : images) {
    if (sum.IsFault()) faults.push_back({.image = image, .agreement = sum.agreement});
  }
  const std::vector<std::vector<Sum>> gaps = SumAcrossGaps(pairs, sequences);
  for (size_t s = 0; s < gaps.size(); ++s) {
    for (size_t i = 0; i + 1 < gaps[s].size(); ++i) {
      if (!gaps[s][i].IsFault()) continue;
      faults.push_back({.image = sequences[s][i],
                        .next = sequences[s][i + 1],
                        .agreement = gaps[s][i].agreement});
    }
  }
  return faults;
}

}  // namespace orbweave
