// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/architecture/components.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/architecture/layers.h"

namespace orbweave::architecture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Key;
using testing::Pair;

SourceFile Including(const std::string& path, const std::vector<std::string>& targets) {
  std::string text;
  for (const std::string& target : targets) text += "#include \"" + target + "\"\n";
  return {path, text};
}

TEST(FindComponents, TakesHeaderAndSourceAsOne) {
  const ComponentGraph graph =
      FindComponents({Including("core/a.cc", {"core/a.h", "vector", "core/b.h"}),
                      Including("core/a.h", {"core/c.h"}),
                      Including("core/b.h", {}),
                      Including("core/c.h", {})});
  EXPECT_THAT(graph.at("core/a"),
              ElementsAre(Pair("core/b", "core/a.cc:3"), Pair("core/c", "core/a.h:1")));
  EXPECT_THAT(graph.at("core/b"), IsEmpty());
}

TEST(FindComponents, CountsASecondSourceToTheHeaderThatItContinues) {
  const ComponentGraph graph = FindComponents({Including("core/job.h", {}),
                                               Including("core/job_machine.h", {}),
                                               Including("core/job_machine_late_report.cc", {}),
                                               Including("core/job_desk.h", {}),
                                               Including("core/jobs.cc", {}),
                                               Including("core_job/a.cc", {})});
  EXPECT_THAT(graph,
              ElementsAre(Key("core/job"),
                          Key("core/job_desk"),
                          Key("core/job_machine"),
                          Key("core/jobs"),
                          Key("core_job/a")));
}

TEST(FindCycles, FindsNoneWhereAllLookDown) {
  EXPECT_THAT(FindCycles(FindComponents({Including("a.h", {"b.h", "c.h"}),
                                         Including("b.h", {"c.h"}),
                                         Including("b.cc", {"b.h", "c.h"}),
                                         Including("c.h", {})})),
              IsEmpty());
}

TEST(FindCycles, SaysWhichLinesCloseACircleThatNoFileShowsAlone) {
  EXPECT_THAT(FindCycles(FindComponents({Including("verb.h", {"noun.h"}),
                                         Including("verb.cc", {"verb.h", "part.h"}),
                                         Including("part.h", {"helper.h", "noun.h"}),
                                         Including("helper.h", {"verb.h"}),
                                         Including("noun.h", {}),
                                         Including("top.cc", {"verb.h"})})),
              ElementsAre("helper -> verb (helper.h:1), verb -> part (verb.cc:2), "
                          "part -> helper (part.h:1)"));
}

TEST(FindCycles, TellsOneCircleOfEachGroup) {
  EXPECT_THAT(FindCycles(FindComponents({Including("a.h", {"b.h"}),
                                         Including("b.h", {"c.h"}),
                                         Including("c.h", {"a.h", "b.h"}),
                                         Including("x.h", {"y.h"}),
                                         Including("y.cc", {"x.h"}),
                                         Including("y.h", {"a.h"})})),
              ElementsAre("a -> b (a.h:1), b -> c (b.h:1), c -> a (c.h:1)",
                          "x -> y (x.h:1), y -> x (y.cc:1)"));
}

/// The folders of the product: those of LAYERS, which holds every folder, but for tests.
std::vector<std::string> ProductFolders() {
  std::vector<std::string> folders;
  for (const auto& [folder, row] : ParseLayers(ReadRepositoryFile("LAYERS")).row_of_folder) {
    if (!folder.starts_with("tests") && folder != "bench") folders.push_back(folder);
  }
  return folders;
}

TEST(Repository, HasNoCircleOfComponents) {
  std::vector<SourceFile> files = ReadTree(ProductFolders());
  std::erase_if(files, [](const SourceFile& file) { return !IsCpp(file.path); });
  const ComponentGraph graph = FindComponents(files);
  EXPECT_GT(graph.size(), 400U);
  for (const std::string& cycle : FindCycles(graph))
    ADD_FAILURE() << "a header of nouns (types alone) that both include would open this circle:\n"
                  << cycle;
}

}  // namespace
}  // namespace orbweave::architecture
