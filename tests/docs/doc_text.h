// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace orbweave::docs {

/// A command of a document.
struct DocCommand {
  int line = 0;
  std::string text{};         ///< without what follows a #
  bool is_elsewhere = false;  ///< it needs what a test has not
};

/// The commands of a Markdown document: every line of a fenced block of no language. One that ends
/// in "# elsewhere" or "# elsewhere: NOTE" is for other machines than that of a test.
[[nodiscard]] std::vector<DocCommand> CommandsOf(const std::string& markdown);

/// What stands between single backticks, outside of fenced blocks.
[[nodiscard]] std::vector<std::string> InlineCodeOf(const std::string& markdown);

/// Whether a line of help offers an option, by this very name.
[[nodiscard]] bool HelpOffers(const std::string& help, const std::string& option);

/// The options ("--output") of a command line.
[[nodiscard]] std::vector<std::string> OptionsIn(const std::string& command);

/// The words of a command line, without assignments of the environment before it.
[[nodiscard]] std::vector<std::string> WordsOf(const std::string& command);

}  // namespace orbweave::docs
