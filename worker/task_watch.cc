// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_watch.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace orbweave {

std::optional<std::string> TaskWatch::Look(double now_s, double cpu_s) {
  constexpr double kBusyShare = 0.01;
  if (cpu_s - busy_.cpu_s >= kBusyShare * limits_.stall_s) busy_ = {now_s, cpu_s};
  if (now_s - busy_.now_s >= limits_.stall_s)
    return absl::StrCat("it hung: no sign of life for ", limits_.stall_s, " s");
  if (now_s - sign_.now_s >= limits_.stall_s && cpu_s - sign_.cpu_s >= limits_.stall_s) {
    return absl::StrCat("it spun: no sign of life for ", limits_.stall_s, " s of processor time");
  }
  if (now_s - begin_s_ >= limits_.total_s)
    return absl::StrCat("it took longer than ", limits_.total_s, " s");
  return std::nullopt;
}

double TaskWatch::Wait() const {
  constexpr double kLongest_s = 1.0;
  return std::min({kLongest_s, 0.1 * limits_.stall_s, 0.1 * limits_.total_s});
}

}  // namespace orbweave
