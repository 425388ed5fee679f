// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/options.h"

namespace orbweave {

/// What a cross check says of a model.
enum class CheckLevel { kGood, kDoubtful, kBad };

template <>
struct EnumNames<CheckLevel> {
  static constexpr std::array<std::pair<CheckLevel, std::string_view>, 3> kNames = {
      {{CheckLevel::kGood, "good"},
       {CheckLevel::kDoubtful, "doubtful"},
       {CheckLevel::kBad, "bad"}}};
};

/// On which side of its limit a right model stays.
enum class CheckBound { kAtMost, kAtLeast };

/// One number by which a finished model is held against something that did not make it: its own
/// steps, the verified pairs, GNSS. Checks that are good are reported too: a check with a limit is
/// good where IsWithinLimit, and nowhere else.
struct CrossCheck {
  std::string name{};  ///< short and stable, for scripts: "sequence_steps", "gnss_clock"
  double value = 0.0;  ///< what was judged
  double limit = 0.0;  ///< what a right model stays within; 0: no limit is known
  std::string unit{};  ///< of both: "m", "deg", "share", "s", "px", "count", "sigma"
  CheckLevel level = CheckLevel::kGood;
  std::string sentence{};  ///< for people; where not good: what may be wrong and what to do
  CheckBound bound = CheckBound::kAtMost;  ///< the kind of limit
  bool is_told = true;  ///< false: nothing in the job tells (Verdict::unchecked); then good

  /// True where no limit is known.
  [[nodiscard]] bool IsWithinLimit() const {
    if (limit == 0.0) return true;
    return bound == CheckBound::kAtMost ? value <= limit : value >= limit;
  }
};

/// The worst of all checks, and what the checks that are not good say, worst first.
struct Verdict {
  CheckLevel level = CheckLevel::kGood;
  std::vector<std::string> reasons{};
  std::vector<std::string> unchecked{};  ///< what no check could see (ListUnchecked)
};

}  // namespace orbweave
