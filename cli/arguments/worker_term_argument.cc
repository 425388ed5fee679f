// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/worker_term_argument.h"

#include <algorithm>
#include <ctime>
#include <random>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace orbweave {

absl::StatusOr<int64_t> ParseUnixTime(const std::string& text) {
  int64_t unix_s = 0;
  if (absl::SimpleAtoi(text, &unix_s)) return unix_s;
  std::tm time{};
  time.tm_isdst = -1;
  const char* const rest = ::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S", &time);
  const std::string zone = rest == nullptr ? "?" : rest;
  if (zone == "Z") return ::timegm(&time);
  if (zone.empty()) return std::mktime(&time);
  return absl::InvalidArgumentError(absl::StrCat(
      text, " is no time: give seconds since 1970, or as in 2026-11-23T18:00:00, with Z for UTC"));
}

absl::StatusOr<WorkerTerm> WorkerTermArgument::Begin(int64_t now_unix_s) const {
  constexpr double kShorter = 0.1;
  WorkerTerm begun = term;
  std::random_device device;
  begun.lifetime_s *= std::uniform_real_distribution<double>(1.0 - kShorter, 1.0)(device);
  if (until.empty()) return begun;
  ORBWEAVE_ASSIGN_OR_RETURN(const int64_t until_unix_s, ParseUnixTime(until));
  if (until_unix_s <= now_unix_s)
    return absl::InvalidArgumentError(absl::StrCat("--until ", until, " is over"));
  begun.stays_s = static_cast<double>(until_unix_s - now_unix_s);
  return begun;
}

void AddWorkerTermArguments(CLI::App& command, WorkerTermArgument& argument) {
  command
      .add_option("--idle-exit",
                  argument.term.idle_s,
                  "Seconds without a task after which the worker ends, with exit code 0")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--patience",
                  argument.term.patience_s,
                  "Seconds to wait for a coordinator that does not answer (default: without end); "
                  "then the exit code is 3")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--lifetime",
                  argument.term.lifetime_s,
                  "Seconds, or up to a tenth less, after which the worker takes no more tasks, "
                  "finishes those it has and ends with exit code 75")
      ->check(CLI::PositiveNumber);
  command.add_option("--until",
                     argument.until,
                     "Time at which this machine is taken back, in seconds since 1970 or as in "
                     "2026-11-23T18:00:00: tasks that usually take longer go elsewhere, and what "
                     "runs is given back in time, with exit code 75");
}

}  // namespace orbweave
