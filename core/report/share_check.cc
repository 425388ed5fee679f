// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/share_check.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

/// Down to which it is good, of `whole`.
double WantedShare(size_t whole) {
  return whole < 2 ? 1.0 : std::min(kWantedShare, ShareOf(whole - 1, whole));
}

}  // namespace

double ShareOf(size_t part, size_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::string CountOf(size_t part, size_t whole, const char* what) {
  return absl::StrCat(part, " of ", whole, " ", what);
}

CheckLevel LevelOfShare(size_t part, size_t whole) {
  if (part + 1 >= whole && part > 0) return CheckLevel::kGood;
  const double share = ShareOf(part, whole);
  return share < kMostShare     ? CheckLevel::kBad
         : share < kWantedShare ? CheckLevel::kDoubtful
                                : CheckLevel::kGood;
}

CrossCheck ShareCheck(const char* name, size_t part, size_t whole, CheckLevel level) {
  return {.name = name,
          .value = ShareOf(part, whole),
          .limit = WantedShare(whole),
          .unit = "share",
          .level = level,
          .bound = CheckBound::kAtLeast};
}

}  // namespace orbweave
