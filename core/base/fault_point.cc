// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/fault_point.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_split.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

struct Fault {
  std::string point{};
  FaultSide side = FaultSide::kBefore;
  std::atomic<int64_t> passings_left{0};
};

/// Null: nothing is to happen.
Fault* WantedFault() {
  const char* variable = std::getenv("ORBWEAVE_FAULT");
  if (variable == nullptr) return nullptr;
  const std::vector<std::string> words =
      absl::StrSplit(std::string(variable), absl::ByAnyChar(".:"));
  int64_t count = 0;
  ORBWEAVE_CHECK(words.size() == 3 && (words[1] == "before" || words[1] == "after") &&
                 absl::SimpleAtoi(words[2], &count) && count > 0);
  static Fault fault;
  fault.point = words[0];
  fault.side = words[1] == "before" ? FaultSide::kBefore : FaultSide::kAfter;
  fault.passings_left = count;
  return &fault;
}

}  // namespace

void FaultPoint(std::string_view point, FaultSide side) {
  static Fault* const fault = WantedFault();
  if (fault == nullptr || fault->side != side || fault->point != point) return;
  if (--fault->passings_left == 0) ::kill(::getpid(), SIGKILL);
}

}  // namespace orbweave
