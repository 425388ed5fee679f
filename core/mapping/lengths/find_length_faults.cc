// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/find_length_faults.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace orbweave {
namespace {

constexpr double kFewestRays = 50.0;
constexpr uint32_t kFewestPairs = 3;
constexpr double kDeviations = 2.0;

struct Sum {
  LengthAgreement agreement{};
  uint32_t pairs = 0;

  void Add(const LengthAgreement& pair) {
    agreement.Add(pair);
    pairs += pair.told > 0.0 ? 1 : 0;
  }
  [[nodiscard]] bool IsFault(double min_agreeing) const {
    return TellsEnough(agreement, pairs) && agreement.Share() < min_agreeing;
  }
};

/// nullopt where nothing is wrong with the way.
std::optional<LengthFault> TearAt(const GapLength& gap) {
  const auto tear = [&](const LengthAgreement& agreement, LengthFaultKind kind) {
    return LengthFault{gap.between.a, gap.between.b, agreement, kind};
  };
  if (IsAskew(gap.matches)) return tear(gap.matches, LengthFaultKind::kHinge);
  if (const double scale = std::exp(-gap.scale_jump); scale < kMinScaleOfOther)
    return tear({.told = 1.0, .agreeing = scale}, LengthFaultKind::kScale);
  if (gap.is_borne_out) return std::nullopt;
  if (Sum{gap.agreement, gap.pairs}.IsFault(kMinAgreeingAcross))
    return tear(gap.agreement, LengthFaultKind::kWay);
  if (IsToldElsewhere(gap.here, gap.elsewhere))
    return tear({.told = gap.here + gap.elsewhere, .agreeing = gap.here},
                LengthFaultKind::kElsewhere);
  if (IsToldByWall(gap.wall.agreeing, gap.wall.told - gap.wall.agreeing))
    return tear(gap.wall, LengthFaultKind::kWall);
  return std::nullopt;
}

/// Whether a way is more at fault than another: by more than one wall, or as much and agrees less.
bool IsWorse(const LengthFault& one, const LengthFault& other) {
  const auto rank = [](const LengthFault& fault) {
    return std::pair(fault.kind == LengthFaultKind::kWall, fault.agreement.Share());
  };
  return rank(one) < rank(other);
}

/// Of ways at fault that follow each other, from `start` on, the worst. It takes them: ways that
/// lead in a ring, which no drive does, end.
LengthFault WorstFrom(ImageId start, std::map<ImageId, LengthFault>& tears) {
  std::optional<LengthFault> worst;
  for (auto tear = tears.find(start); tear != tears.end();) {
    const LengthFault here = tear->second;
    tears.erase(tear);
    if (!worst || IsWorse(here, *worst)) worst = here;
    tear = tears.find(*here.next);
  }
  return *worst;
}

std::vector<LengthFault> FindTears(std::span<const GapLength> gaps) {
  std::map<ImageId, LengthFault> tears;  // by the image before
  std::set<ImageId> ends;
  for (const GapLength& gap : gaps) {
    const std::optional<LengthFault> tear = TearAt(gap);
    if (!tear) continue;
    tears.emplace(gap.between.a, *tear);
    ends.insert(gap.between.b);
  }
  std::vector<ImageId> starts;
  for (const auto& [start, tear] : tears) {
    if (!ends.contains(start)) starts.push_back(start);
  }
  std::vector<LengthFault> worst;
  for (const ImageId start : starts) worst.push_back(WorstFrom(start, tears));
  while (!tears.empty()) worst.push_back(WorstFrom(tears.begin()->first, tears));
  return worst;
}

}  // namespace

double LengthFault::MinShare() const {
  switch (kind) {
    case LengthFaultKind::kImage:
      return kMinAgreeingLengths;
    case LengthFaultKind::kWay:
      return kMinAgreeingAcross;
    case LengthFaultKind::kElsewhere:
    case LengthFaultKind::kWall:
      return kMinAgreeingOfTwo;
    case LengthFaultKind::kScale:
      return kMinScaleOfOther;
    case LengthFaultKind::kHinge:
      return kMinAgreeingMatches;
  }
  return kMinAgreeingLengths;
}

bool TellsEnough(const LengthAgreement& agreement, uint32_t pairs) {
  return pairs >= kFewestPairs && agreement.told >= kFewestRays;
}

bool IsAskew(const LengthAgreement& matches) {
  return matches.told >= kFewestRays && matches.Share() < kMinAgreeingMatches;
}

double DeviationsElsewhere(double here, double elsewhere) {
  const double sum = here + elsewhere;
  return sum > 0.0 ? (elsewhere - here) / std::sqrt(sum) : 0.0;
}

bool IsToldElsewhere(double here, double elsewhere) {
  return DeviationsElsewhere(here, elsewhere) > kDeviations;
}

bool IsToldByWall(double here, double elsewhere) {
  return DeviationsElsewhere(here, elsewhere) > kDeviationsOfWall;
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
    if (sum.IsFault(kMinAgreeingLengths))
      faults.push_back({.image = image, .agreement = sum.agreement});
  }
  std::ranges::copy(FindTears(gaps), std::back_inserter(faults));
  return faults;
}

}  // namespace orbweave
