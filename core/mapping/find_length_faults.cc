// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_length_faults.h"

#include <map>

namespace orbweave {
namespace {

constexpr double kFewestRays = 50.0;
constexpr uint32_t kFewestPairs = 3;

struct Sum {
  LengthAgreement agreement{};
  uint32_t pairs = 0;

  void Add(const LengthAgreement& pair) {
    agreement.Add(pair);
    pairs += pair.told > 0.0 ? 1 : 0;
  }
  [[nodiscard]] bool IsFault() const {
    return TellsEnough(agreement, pairs) && agreement.Share() < kMinAgreeingLengths;
  }
};

}  // namespace

bool TellsEnough(const LengthAgreement& agreement, uint32_t pairs) {
  return pairs >= kFewestPairs && agreement.told >= kFewestRays;
}

std::vector<LengthFault> FindLengthFaults(std::span<const PairLength> pairs,
                                          std::span<const GapLength> gaps) {
  std::map<ImageId, Sum> images;
  for (const PairLength& pair : pairs) {
    images[pair.pair.a].Add(pair.agreement);
    images[pair.pair.b].Add(pair.agreement);
  }
  std::vector<LengthFault> faults;
  for (const auto& [image, sum] : images) {
    if (sum.IsFault()) faults.push_back({.image = image, .agreement = sum.agreement});
  }
  for (const GapLength& gap : gaps) {
    if (!Sum{gap.agreement, gap.pairs}.IsFault()) continue;
    faults.push_back({.image = gap.between.a, .next = gap.between.b, .agreement = gap.agreement});
  }
  return faults;
}

}  // namespace orbweave
