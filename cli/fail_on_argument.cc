// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fail_on_argument.h"

#include <map>
#include <string>

#include "cli/exit_code.h"
#include "core/io/level_text.h"

namespace orbweave {

CLI::Option* AddFailOnArgument(CLI::App& command, FailOn& fail_on) {
  static const std::map<std::string, CheckLevel> kLevels = {{"doubtful", CheckLevel::kDoubtful},
                                                            {"bad", CheckLevel::kBad}};
  return command
      .add_option_function<CheckLevel>(
          "--fail-on",
          [&fail_on](const CheckLevel& level) { fail_on = level; },
          "End with exit code 4 when the model is judged so, or worse; results are written all the "
          "same")
      ->transform(CLI::CheckedTransformer(kLevels))
      ->type_name("doubtful|bad");
}

absl::Status CheckVerdict(const Verdict& verdict, const FailOn& fail_on) {
  if (!fail_on || verdict.level < *fail_on) return absl::OkStatus();
  return VerdictError("the model is judged " + LevelText(verdict.level) +
                      ", see the verdict above (--fail-on " + LevelText(*fail_on) + ")");
}

}  // namespace orbweave
