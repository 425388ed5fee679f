// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a job says of its model: in the terminal, in the files, to the shell.

#include <gmock/gmock.h>

#include <algorithm>

#include "core/io/text_fields.h"
#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;

TEST(Verdict, ARightStreetIsGoodAndPassesWhateverItIsHeldTo) {
  const TemporaryFolder folder;
  std::vector<std::string> command = ReconstructCorridor(folder / "out", 2);
  command.insert(command.end(), {"--fail-on", "doubtful"});
  const CommandOutcome run = RunCommand(command);
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_TRUE(run.out.ends_with("  verdict     good\n")) << run.out;
  const nlohmann::json report = ReportOf(folder / "out");
  EXPECT_EQ(report["verdict"]["level"], "good");
  EXPECT_TRUE(report["verdict"]["reasons"].empty());
  EXPECT_GE(report["checks"].size(), 6U);
}

TEST(Verdict, AStreetThatIsNotPlacedWholeIsDoubtedEverywhereAndFailsWhereAsked) {
  const TemporaryFolder folder;
  const CommandOutcome made = RunCommand({ORBWEAVE_BINARY,
                                          "synth",
                                          "corridor",
                                          "--panoramas",
                                          "60",
                                          "--tunnel-panoramas",
                                          "10",
                                          "--tunnel-features",
                                          "30",
                                          "--output",
                                          folder / "street"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  std::vector<std::string> command = {ORBWEAVE_BINARY,
                                      "reconstruct",
                                      "--database",
                                      folder / "street/corridor.db",
                                      "--gnss",
                                      folder / "street/gnss.csv",
                                      "--output",
                                      folder / "out",
                                      "--fail-on",
                                      "doubtful"};
  const CommandOutcome run = RunCommand(command);
  const nlohmann::json report = ReportOf(folder / "out");
  ASSERT_LT(report["registered"], 57) << "the street is whole: nothing to doubt";
  EXPECT_EQ(run.exit_code, 4) << run.out;
  EXPECT_THAT(run.err, HasSubstr("judged " + std::string(report["verdict"]["level"])));
  EXPECT_NE(report["verdict"]["level"], "good");
  const std::string reason = report["verdict"]["reasons"][0];
  EXPECT_THAT(run.out, HasSubstr(reason));
  const std::string html = ReadAll(folder / "out/report.html");
  EXPECT_LT(html.find("Verdict: "), html.find("<h2>Trajectory"));
  command.back() = "bad";
  EXPECT_EQ(RunCommand(command).exit_code, report["verdict"]["level"] == "bad" ? 4 : 0);
  command.back() = "good";
  EXPECT_EQ(RunCommand(command).exit_code, 2);

  // Whoever is in a model is in cameras.csv, with the model's number.
  const std::string csv = ReadAll(folder / "out/cameras.csv");
  int registered = 0;
  int loose = 0;
  for (const std::string_view line : SplitLines(csv)) {
    const std::vector<std::string> cells = SplitFields(line, ',');
    if (cells.size() < 20 || cells[0] == "name") continue;
    registered += cells[11] == "registered" ? 1 : 0;
    loose += cells[11] == "loose" ? 1 : 0;
    if (cells[11] != "registered") continue;
    EXPECT_LT(std::stoul(cells[16]), report["models"].get<size_t>()) << line;
    EXPECT_GT(std::stoul(cells[18]), 0U) << line;
  }
  EXPECT_EQ(registered, report["registered"]);
  EXPECT_EQ(
      std::ranges::count_if(report["images"],
                            [](const nlohmann::json& image) { return image["state"] == "loose"; }),
      loose);
}

}  // namespace
}  // namespace orbweave::testing
