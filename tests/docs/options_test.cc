// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What documents say of options of the command line, held against the program's own help.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>

#include "tests/docs/doc_text.h"
#include "tests/support/command.h"

namespace orbweave::docs {
namespace {

using ::testing::ElementsAre;
using testing::ReadAll;
using testing::RunCommand;

const std::string kSource = ORBWEAVE_SOURCE_DIR;

/// Every document by its path in the source.
std::map<std::string, std::string> Documents() {
  std::map<std::string, std::string> documents;
  for (const char* name : {"README.md", "CONTRIBUTING.md"})
    documents[name] = ReadAll(kSource + "/" + name);
  for (const auto& file : std::filesystem::directory_iterator(kSource + "/docs")) {
    if (file.path().extension() == ".md")
      documents["docs/" + file.path().filename().string()] = ReadAll(file.path().string());
  }
  return documents;
}

/// What `orbweave WORDS --help` says.
const std::string& HelpOf(const std::string& words) {
  static std::map<std::string, std::string> helps;
  const auto [help, is_new] = helps.try_emplace(words);
  if (is_new) {
    std::vector<std::string> command = {ORBWEAVE_BINARY};
    for (const std::string& word : WordsOf(words)) command.push_back(word);
    command.emplace_back("--help");
    help->second = RunCommand(command).out;
  }
  return help->second;
}

/// Whether a help lists a subcommand of this name.
bool Lists(const std::string& help, const std::string& name) {
  const size_t list = help.find("\nSubcommands:\n");
  return list != std::string::npos && help.find("\n  " + name + " ", list) != std::string::npos;
}

/// The help that tells of a command line: of its subcommand, or the one below. Nothing: it is none
/// of ours, or a group of commands.
std::optional<std::string> HelpFor(const std::string& command) {
  std::vector<std::string> words = WordsOf(command);
  if (!words.empty() && words[0] == "orbweave") words.erase(words.begin());
  if (words.empty() || !Lists(HelpOf(""), words[0])) return std::nullopt;
  const std::string& help = HelpOf(words[0]);
  if (help.find("\nSubcommands:\n") == std::string::npos) return help;
  if (words.size() < 2 || !Lists(help, words[1])) return std::nullopt;
  // The other options of `launch slurm` are those of `run`, to which it hands them on.
  return HelpOf(words[0] + " " + words[1]) + (words[0] == "launch" ? HelpOf("run") : "");
}

TEST(DocText, HasCommandsOfBlocksWithoutALanguage) {
  const auto commands = CommandsOf(
      "text\n```\na --b  # says elsewhere\n# only says\n\nc '#d' # elsewhere: a cluster\n"
      "e # elsewhere\n```\n```yaml\nx: y\n```\n");
  ASSERT_EQ(commands.size(), 3U);
  EXPECT_EQ(commands[0].text, "a --b");
  EXPECT_EQ(commands[0].line, 3);
  EXPECT_FALSE(commands[0].is_elsewhere);
  EXPECT_EQ(commands[1].text, "c '#d'");
  EXPECT_TRUE(commands[1].is_elsewhere && commands[2].is_elsewhere);
}

TEST(DocText, SeesOptionsByTheirWholeName) {
  EXPECT_THAT(OptionsIn("orbweave run a --output b --set=x.y=1 [--no-z] c--d -e"),
              ElementsAre("--output", "--set", "--no-z"));
  EXPECT_TRUE(HelpOffers("  -n,--name TEXT   a name", "--name"));
  EXPECT_FALSE(HelpOffers("  --name-of TEXT   a name", "--name"));
  EXPECT_TRUE(HelpOffers("  --room,--no-room{false}", "--no-room"));
  EXPECT_THAT(WordsOf("A=b C=d orbweave run"), ElementsAre("orbweave", "run"));
  EXPECT_THAT(InlineCodeOf("a `b c` d\n```\n`e`\n```\n`f\ng`"), ElementsAre("b c", "f g"));
}

TEST(Docs, NameCommandsAndOptionsThatThereAre) {
  int held = 0;
  for (const auto& [path, text] : Documents()) {
    for (const DocCommand& command : CommandsOf(text)) {
      if (WordsOf(command.text).front() != "orbweave") continue;
      const std::optional<std::string> help = HelpFor(command.text);
      ASSERT_TRUE(help.has_value()) << path << ":" << command.line << ": " << command.text;
      for (const std::string& option : OptionsIn(command.text)) {
        EXPECT_TRUE(HelpOffers(*help, option)) << path << ":" << command.line << ": " << option;
        ++held;
      }
    }
    for (const std::string& code : InlineCodeOf(text)) {
      const std::optional<std::string> help = HelpFor(code);
      if (!help) continue;
      for (const std::string& option : OptionsIn(code)) {
        EXPECT_TRUE(HelpOffers(*help, option)) << path << ": `" << code << "`";
        ++held;
      }
    }
  }
  EXPECT_GT(held, 150);
}

}  // namespace
}  // namespace orbweave::docs
