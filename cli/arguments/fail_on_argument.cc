// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/fail_on_argument.h"

#include <string>

#include "cli/process/exit_code.h"
#include "core/io/page/level_text.h"

namespace orbweave {

CLI::Option* AddFailOnArgument(CLI::App& command, FailOn& fail_on) {
  // CLI11's own list of values also takes the numbers behind them.
  const auto problem = [](const std::string& level) -> std::string {
    return level == "doubtful" || level == "bad" ? ""
                                                 : "'" + level + "' is neither doubtful nor bad";
  };
  return command
      .add_option_function<std::string>(
          "--fail-on",
          [&fail_on](const std::string& level) {
            fail_on = level == "bad" ? CheckLevel::kBad : CheckLevel::kDoubtful;
          },
          "End with exit code 4 when the model is judged so, or worse, as is a job that registers "
          "nothing (exit code 1 without this); all results are written all the same")
      ->check(CLI::Validator([problem](std::string& level) { return problem(level); }, "", "level"))
      ->type_name("doubtful|bad");
}

absl::Status CheckVerdict(const Verdict& verdict, const FailOn& fail_on) {
  if (!fail_on || verdict.level < *fail_on) return absl::OkStatus();
  return VerdictError("the model is judged " + LevelText(verdict.level) +
                      ", see the verdict above (--fail-on " + LevelText(*fail_on) + ")");
}

}  // namespace orbweave
