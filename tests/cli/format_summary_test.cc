// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/results/format_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/core/io/made_up_report.h"

namespace orbweave {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(FormatSummary, SaysWhatWasRegisteredAndHowWellItFits) {
  const std::string text = FormatSummary(MadeUpReport(40, 3), "model");
  EXPECT_THAT(text, HasSubstr("  registered  40 of 43 images in 1 model\n"));
  EXPECT_THAT(text, HasSubstr("  points      38412, mean track length 4.76\n"));
  EXPECT_THAT(text, HasSubstr("  residual    0.712 px mean, 0.913 px RMS\n"));
  EXPECT_THAT(text, HasSubstr("  clusters    3, 3 seams"));
  EXPECT_THAT(text, HasSubstr("  outputs     model (open report.html"));
}

TEST(FormatSummary, NamesTheFirstPositionsThatTheModelContradicts) {
  JobReport report = MadeUpReport(40, 3);
  EXPECT_THAT(FormatSummary(report, "model"),
              HasSubstr("  GNSS        38 of 40 positions agree, 1.02 m RMS; 2 contradicted: "
                        "IMG_0020.jpg, IMG_0060.jpg\n"));
  report.gnss.outliers = {"a.jpg", "b.jpg", "c.jpg", "d\x1b[2J.jpg"};
  EXPECT_THAT(FormatSummary(report, "model"),
              HasSubstr("; 4 contradicted: a.jpg, b.jpg, c.jpg, ...\n"));
  report.gnss.outliers = {"d\x1b[2J.jpg"};
  EXPECT_THAT(FormatSummary(report, "model"), Not(HasSubstr("\x1b")));
  report.gnss.outliers.clear();
  EXPECT_THAT(FormatSummary(report, "model"), Not(HasSubstr("contradicted")));
}

TEST(FormatSummary, NamesThemOfAllModels) {
  JobReport report = MadeUpReport(40, 3);
  report.models = 3;
  report.each_model.resize(3);
  EXPECT_THAT(FormatSummary(report, "model"), HasSubstr("IMG_0060.jpg (model 0)\n"));
  report.each_model[0].gnss.outliers = report.gnss.outliers;
  report.each_model[1].gnss.outliers = {"a.jpg"};
  report.each_model[2].gnss.outliers = {"b.jpg"};
  EXPECT_THAT(FormatSummary(report, "model"),
              HasSubstr(" (model 0); of the other models 2 contradicted: a.jpg, b.jpg\n"));
}

TEST(FormatSummary, SaysWhyGnssIsNotUsed) {
  JobReport report = MadeUpReport(40, 3);
  report.gnss = {.reason = "no image has a GNSS position"};
  EXPECT_THAT(FormatSummary(report, "model"),
              HasSubstr("  GNSS        not used: no image has a GNSS position\n"));
}

TEST(FormatSummary, NamesWhatWasLeftOutAWarningADoubtAndEveryStage) {
  const JobReport report = MadeUpReport(40, 3);
  const std::string text = FormatSummary(report, "model");
  EXPECT_THAT(text, HasSubstr("  left out    IMG_0090.jpg: truncated"));
  for (const ReportStage& stage : report.stages) EXPECT_THAT(text, HasSubstr("  " + stage.name));
  EXPECT_THAT(text, HasSubstr("  verdict     doubtful\n"));
  EXPECT_THAT(text, EndsWith("the GNSS clock is <late> by 0.8 s\n")) << "the verdict stands last";
}

TEST(FormatSummary, CutsLongListsAndSaysSo) {
  JobReport report = MadeUpReport(40, 3);
  report.verdict.reasons.assign(20, "something else is wrong");
  EXPECT_THAT(FormatSummary(report, "model"), HasSubstr("8 more reasons, see report.html\n"));
}

}  // namespace
}  // namespace orbweave
