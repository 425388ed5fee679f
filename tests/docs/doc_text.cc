// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/docs/doc_text.h"

#include <regex>
#include <sstream>

namespace orbweave::docs {
namespace {

/// Lines, each with its number and whether it is inside of a block; `language` is that of the
/// block.
template <typename Take>
void ForEachLine(const std::string& markdown, const Take& take) {
  std::istringstream stream(markdown);
  bool is_fenced = false;
  std::string language;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.starts_with("```")) {
      is_fenced = !is_fenced;
      language = line.substr(3);
    } else {
      take(number, line, is_fenced, language);
    }
  }
}

std::string Trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

}  // namespace

std::vector<DocCommand> CommandsOf(const std::string& markdown) {
  static const std::regex kMark(" # elsewhere(:.*)?$");
  std::vector<DocCommand> commands;
  ForEachLine(
      markdown,
      [&](int number, const std::string& line, bool is_fenced, const std::string& language) {
        if (!is_fenced || !language.empty()) return;
        const size_t comment = line.starts_with('#') ? 0 : line.find(" #");
        const std::string text = Trimmed(line.substr(0, comment));
        if (text.empty()) return;
        commands.push_back({number, text, std::regex_search(line, kMark)});
      });
  return commands;
}

std::vector<std::string> InlineCodeOf(const std::string& markdown) {
  static const std::regex kCode("`([^`\n]+)`");
  std::string prose;  // code may go on in the next line
  ForEachLine(markdown, [&](int, const std::string& line, bool is_fenced, const std::string&) {
    if (!is_fenced) prose += line + ' ';
  });
  std::vector<std::string> codes;
  for (std::sregex_iterator it(prose.begin(), prose.end(), kCode), end; it != end; ++it)
    codes.push_back((*it)[1]);
  return codes;
}

bool HelpOffers(const std::string& help, const std::string& option) {
  for (size_t at = help.find(option); at != std::string::npos; at = help.find(option, at + 1)) {
    const char before = at == 0 ? ' ' : help[at - 1];
    const size_t end = at + option.size();
    const char behind = end < help.size() ? help[end] : ' ';
    const bool goes_on = std::isalnum(static_cast<unsigned char>(behind)) != 0 || behind == '-';
    if ((before == ' ' || before == ',') && !goes_on) return true;
  }
  return false;
}

std::vector<std::string> OptionsIn(const std::string& command) {
  static const std::regex kOption(R"((^|[ \[])(--[a-z][a-z0-9-]*))");
  std::vector<std::string> options;
  for (std::sregex_iterator it(command.begin(), command.end(), kOption), end; it != end; ++it)
    options.push_back((*it)[2]);
  return options;
}

std::vector<std::string> WordsOf(const std::string& command) {
  static const std::regex kAssignment("[A-Z_]+=.*");
  std::vector<std::string> words;
  std::istringstream stream(command);
  for (std::string word; stream >> word;) {
    if (words.empty() && std::regex_match(word, kAssignment)) continue;
    words.push_back(word);
  }
  return words;
}

}  // namespace orbweave::docs
