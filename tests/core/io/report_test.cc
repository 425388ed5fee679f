// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/io/html_text.h"
#include "core/io/report_html.h"
#include "core/io/report_json.h"
#include "core/io/report_map.h"
#include "tests/core/io/made_up_report.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

size_t CountOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Every opened element is closed in order; void elements and the document type aside.
bool IsBalanced(const std::string& html) {
  std::vector<std::string> open;
  for (size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const size_t end = html.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = html.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(
        tag.starts_with('/') ? 1 : 0, tag.find_first_of(" /", 1) - (tag.starts_with('/') ? 1 : 0));
    if (tag.starts_with('!') || tag.ends_with('/') || name == "meta") continue;
    if (!tag.starts_with('/')) {
      open.push_back(name);
    } else if (open.empty() || open.back() != tag.substr(1)) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty();
}

TEST(ReportJson, HasEveryKeyAndIsDeterministic) {
  const JobReport report = MadeUpReport(40, 3);
  const auto json = nlohmann::json::parse(ReportJson(report));
  EXPECT_EQ(json["global_adjustment"][0]["rounds"][0]["accepted_costs"][1], 91400.25);
  EXPECT_EQ(json["global_adjustment"][0]["bytes_of_block"][1], 64000);
  for (const char* key : {"images_total",
                          "registered",
                          "not_registered",
                          "points",
                          "observations",
                          "mean_track_length",
                          "residual_px_mean",
                          "residual_px_rms",
                          "clusters",
                          "seams",
                          "gnss",
                          "uncertainty",
                          "stages",
                          "workers",
                          "version"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["not_registered"][0]["name"], "IMG_0007 <script>.jpg");
  EXPECT_EQ(json["stages"][2]["cpu_s"], 92.4);
  EXPECT_EQ(json["seams"][1]["clusters"], nlohmann::json::array({1, 2}));
  EXPECT_EQ(json["gnss"]["outliers"].size(), 2U);
  EXPECT_EQ(json["uncertainty"]["worst"][0]["name"], "IMG_0003.jpg");
  EXPECT_NEAR(json["uncertainty"]["worst"][0]["position_sigma"], 3.742, 1e-3);
  EXPECT_THAT(std::string(json["uncertainty"]["frame"]), HasSubstr("absolute"));
  EXPECT_EQ(ReportJson(report), ReportJson(MadeUpReport(40, 3)));
}

TEST(ReportJson, TakesNamesThatAreNoUtf8AndNumbersThatAreNone) {
  JobReport report;
  report.not_registered = {{"\xff\xfe.jpg", "odd"}};
  report.residual_px_mean = std::nan("");
  EXPECT_TRUE(nlohmann::json::parse(ReportJson(report))["residual_px_mean"].is_null());
}

TEST(ReportHtml, IsOnePageThatFetchesNothing) {
  const std::string html = ReportHtml(MadeUpReport(96, 5));
  EXPECT_TRUE(IsBalanced(html));
  for (const char* outside : {"http:", "https:", "src=", "href=", "@import", "url(", "<script"})
    EXPECT_THAT(html, Not(HasSubstr(outside))) << outside;
  EXPECT_THAT(html, HasSubstr("Harbour street, &lt;second&gt; drive &amp; return"));
  EXPECT_THAT(html, HasSubstr("IMG_0007 &lt;script&gt;.jpg"));
  EXPECT_LT(html.size(), 80000U);
}

TEST(ReportHtml, DefusesStrangersTextWhereverItStands) {
  const std::string hostile = "\"'><script>alert(1)</script>\x1b[2J";
  JobReport report = MadeUpReport(12, 3);
  report.title = report.version = report.options_text = hostile;
  for (ReportImage& image : report.images) image.name += hostile;
  for (ReportStage& stage : report.stages) stage.name = hostile;
  for (ReportSeam& seam : report.seams) {
    seam.used = false;
    seam.reason = hostile;
  }
  for (ReportWorker& worker : report.workers) worker.name = hostile;
  report.not_registered = {{hostile, hostile}};
  report.warnings = {hostile};
  report.gnss.outliers = {hostile};
  report.uncertainty.held_image = report.uncertainty.held_distance_to = hostile;
  for (const bool is_known : {true, false}) {
    report.gnss.used = report.uncertainty.known = is_known;
    report.gnss.reason = report.uncertainty.reason = hostile;
    const std::string html = ReportHtml(report);
    EXPECT_TRUE(IsBalanced(html));
    EXPECT_THAT(html, Not(HasSubstr("<script")));
    EXPECT_THAT(html, Not(HasSubstr("\x1b")));
    EXPECT_THAT(html, HasSubstr("&lt;script&gt;"));
  }
}

TEST(ReportHtml, ShowsEveryImageSeamAndOutlierOnTheMap) {
  const JobReport report = MadeUpReport(96, 5);
  const std::string map = TrajectoryMapSvg(report, 0);
  EXPECT_EQ(CountOf(map, "<circle"), 96U);
  EXPECT_EQ(CountOf(map, "class=\"seam"), report.seams.size());
  EXPECT_EQ(CountOf(map, "class=\"seam unused"), 1U);
  EXPECT_EQ(CountOf(map, "class=\"outlier"), 2U);
  EXPECT_THAT(map, HasSubstr(">N</text>"));
  EXPECT_THAT(map, HasSubstr(">50 m</text>"));
  EXPECT_EQ(TrajectoryMapSvg(report, 1), "");
}

TEST(ReportHtml, DrawsEllipsesOfAllThatIsKnownAndCutsTheLargest) {
  JobReport report = MadeUpReport(48, 5);
  const std::string map = TrajectoryMapSvg(report, 0);
  EXPECT_EQ(CountOf(map, "<ellipse"), 47U);
  EXPECT_EQ(CountOf(map, "sigma cut"), 1U);
  EXPECT_THAT(map, HasSubstr("ellipses: one sigma, x "));
  // Twice as far along x as along y, flat on the page.
  EXPECT_EQ(CountOf(map, "rotate(0)"), 47U);
  for (ReportImage& image : report.images) image.uncertainty.reset();
  EXPECT_THAT(TrajectoryMapSvg(report, 0), Not(HasSubstr("ellipse")));
}

TEST(ReportHtml, KeepsTheLeastCertainImageOfALongStreet) {
  EXPECT_EQ(CountOf(TrajectoryMapSvg(MadeUpReport(2000, 20), 0), "sigma cut"), 1U);
}

TEST(ReportHtml, SaysWhatSigmasAreRelativeTo) {
  JobReport report = MadeUpReport(40, 3);
  EXPECT_THAT(ReportHtml(report), HasSubstr("absolute: the frame is held by GNSS"));
  report.uncertainty.held_image = "<a>.jpg";
  report.uncertainty.held_distance_to = "b.jpg";
  EXPECT_THAT(
      ReportHtml(report),
      HasSubstr("relative to &lt;a&gt;.jpg, whose pose is held, as is its distance to b.jpg"));
  EXPECT_THAT(ReportHtml(MadeUpReport(2, 1)), HasSubstr("unknown: too few &lt;images&gt;"));
}

TEST(ReportHtml, StaysSmallForLongStreets) {
  EXPECT_LT(ReportHtml(MadeUpReport(20000, 200)).size(), 1500000U);
}

TEST(ReportHtml, ShortensFiguresThatNoTileOrAxisHolds) {
  JobReport report = MadeUpReport(12, 3);
  report.points = 9'999'999;
  report.observations = 73'428'029;
  for (uint64_t& count : report.residual_histogram.counts) count = 7'400'000;
  const std::string html = ReportHtml(report);
  EXPECT_THAT(html, HasSubstr("9,999,999"));
  EXPECT_THAT(html, HasSubstr("73.4 <small>million</small>"));
  EXPECT_THAT(html, HasSubstr(">4 M</text>"));
  EXPECT_THAT(html, HasSubstr(">8 M</text>"));
}

TEST(ReportHtml, TakesDegenerateReports) {
  JobReport report;
  EXPECT_TRUE(IsBalanced(ReportHtml(report)));
  report = MadeUpReport(1, 1);
  EXPECT_TRUE(IsBalanced(ReportHtml(report)));
  report = MadeUpReport(30, 3);
  report.gnss = {};
  report.origin.reset();
  for (ReportImage& image : report.images) image.centre_in_world = {0, 0, 0};
  const std::string html = ReportHtml(report);
  EXPECT_TRUE(IsBalanced(html));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  EXPECT_THAT(html, Not(HasSubstr("inf,")));
}

TEST(EscapeHtml, KeepsTextAndDefusesTheRest) {
  EXPECT_EQ(EscapeHtml("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
  EXPECT_EQ(EscapeHtml("Straße 東京 🚋"), "Straße 東京 🚋");
  EXPECT_EQ(EscapeHtml("\xff\xc0\x80\x01"), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(NumberTexts, ReadWell) {
  EXPECT_EQ(CountText(0), "0");
  EXPECT_EQ(CountText(999), "999");
  EXPECT_EQ(CountText(1234567), "1,234,567");
  EXPECT_EQ(ShortText(0.0), "0");
  EXPECT_EQ(ShortText(50.0), "50");
  EXPECT_EQ(ShortText(0.0314), "0.031");
  EXPECT_EQ(ShortText(1234.6), "1,235");
  EXPECT_EQ(ShortText(-7.25), "-7.25");
  EXPECT_EQ(SigmaText(0.000314), "0.00031");
  EXPECT_EQ(SigmaText(4.23), "4.2");
  EXPECT_EQ(SigmaText(0.0), "0");
  EXPECT_EQ(DecimalText(-0.0001, 2), "0.00");
  EXPECT_EQ(DurationText(4.26), "4.3 s");
  EXPECT_EQ(DurationText(185.0), "3 min 05 s");
  EXPECT_EQ(DurationText(7620.0), "2 h 07 min");
}

TEST(ReportHtml, TellsTheStepsOfTheGlobalAdjustment) {
  const std::string html = ReportHtml(MadeUpReport(40, 3));
  EXPECT_THAT(html, HasSubstr("<td>1</td><td>7</td><td>180250.5</td><td>91399.5</td>"));
  EXPECT_THAT(html, HasSubstr("stopped before it converged"));
  EXPECT_THAT(html, HasSubstr("2 blocks; for a step a block sends 64 kB at most"));
}

}  // namespace
}  // namespace orbweave
