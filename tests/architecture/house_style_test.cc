// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace orbweave::architecture {
namespace {

const std::vector<std::string> kProductRoots = {
    "core", "proto", "security", "objects", "stages", "coordinator", "worker", "cli"};

const std::vector<std::string> kSourceRoots = {"core",
                                               "proto",
                                               "security",
                                               "objects",
                                               "stages",
                                               "coordinator",
                                               "worker",
                                               "cli",
                                               "tests",
                                               "bench"};

// All that is under version control, apart from hidden folders.
const std::vector<std::string> kAllRoots = {"core",
                                            "proto",
                                            "security",
                                            "objects",
                                            "stages",
                                            "coordinator",
                                            "worker",
                                            "cli",
                                            "tests",
                                            "bench",
                                            "cmake",
                                            "deploy",
                                            "docs",
                                            ".ci",
                                            "CMakeLists.txt",
                                            "CMakePresets.json",
                                            "LAYERS",
                                            "README.md",
                                            "CONTRIBUTING.md"};

// Absolute paths that exist on one machine only. Written in pieces, so that this file has none.
std::vector<int> LinesWithMachinePaths(const std::string& text) {
  static const std::regex kPath(std::string("(^|[^A-Za-z0-9_.}/*-])/(wo") + "rk|ho" + "me|ro" +
                                "ot|Us" + "ers|data|mnt)/[A-Za-z0-9_.]");
  std::vector<int> lines;
  std::istringstream stream(text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (std::regex_search(line, kPath)) lines.push_back(number);
  }
  return lines;
}

// The structs and classes that a file defines where other files could see them.
std::vector<std::string> NamesOfTypes(const std::string& text) {
  static const std::regex kType(R"((struct|class|enum class) (\w+)( final)?( [:{].*)?)");
  std::vector<std::string> names;
  std::istringstream stream(text);
  bool is_private = false;
  for (std::string line; std::getline(stream, line);) {
    if (line == "namespace {") is_private = true;
    if (line == "}  // namespace") is_private = false;
    if (std::smatch match; !is_private && std::regex_match(line, match, kType))
      names.push_back(match[2]);
  }
  return names;
}

bool SaysLicence(const std::string& text) {
  const std::string head = text.substr(0, 400);
  return head.find("SPDX-FileCopyrightText: The Orbweave authors") != std::string::npos &&
         head.find("SPDX-License-Identifier: BSD-3-Clause") != std::string::npos;
}

TEST(LinesWithMachinePaths, SeesAbsolutePathsOnly) {
  const std::string folder = std::string("/ho") + "me/somebody";
  EXPECT_EQ(LinesWithMachinePaths("fine\nopen(\"" + folder + "/a.jpg\")\n"), (std::vector<int>{2}));
  EXPECT_TRUE(LinesWithMachinePaths("core" + folder + "\n${ROOT}" + folder + "\n").empty());
}

TEST(NamesOfTypes, SeesDefinitionsThatOtherFilesCouldSee) {
  EXPECT_EQ(
      NamesOfTypes("struct A {\n  struct Inner {};\n};\nstruct Declared;\nclass B : public A {\n"
                   "namespace {\nstruct Private {\n}  // namespace\nenum class C { kNone };\n"),
      (std::vector<std::string>{"A", "B", "C"}));
}

// Two types of one name make a program of undefined behaviour: the linker keeps the destructor of
// one of them, for both.
TEST(HouseStyle, NoTwoTypesShareAName) {
  std::map<std::string, std::string> file_of_type;
  for (const SourceFile& file : ReadTree(kProductRoots)) {
    if (!IsCpp(file.path)) continue;
    for (const std::string& name : NamesOfTypes(file.text)) {
      const auto [first, is_new] = file_of_type.emplace(name, file.path);
      EXPECT_TRUE(is_new) << name << " in " << first->second << " and " << file.path;
    }
  }
}

TEST(HouseStyle, EveryHeaderIsIncludedOnce) {
  for (const SourceFile& file : ReadTree(kSourceRoots)) {
    if (!file.path.ends_with(".h")) continue;
    EXPECT_NE(file.text.find("#pragma once\n"), std::string::npos) << file.path;
  }
}

TEST(HouseStyle, EverySourceStatesItsLicence) {
  for (const SourceFile& file : ReadTree(kSourceRoots)) {
    if (!IsCpp(file.path) && !file.path.ends_with(".proto")) continue;
    EXPECT_TRUE(SaysLicence(file.text)) << file.path;
  }
}

TEST(HouseStyle, NoFileKnowsOneMachine) {
  for (const SourceFile& file : ReadTree(kAllRoots)) {
    for (const int line : LinesWithMachinePaths(file.text))
      ADD_FAILURE() << file.path << ":" << line;
  }
}

TEST(HouseStyle, NoSourceIsIndentedByTabsOrEndsInCarriageReturns) {
  for (const SourceFile& file : ReadTree(kSourceRoots)) {
    if (!IsCpp(file.path)) continue;
    EXPECT_EQ(file.text.find('\t'), std::string::npos) << file.path;
    EXPECT_EQ(file.text.find('\r'), std::string::npos) << file.path;
  }
}

}  // namespace
}  // namespace orbweave::architecture
