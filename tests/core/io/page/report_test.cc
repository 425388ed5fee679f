// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "core/io/page/cluster_colors.h"
#include "core/io/page/html_text.h"
#include "core/io/page/map_symbols.h"
#include "core/io/page/report_html.h"
#include "core/io/page/report_json.h"
#include "core/io/page/report_map.h"
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
                          "residual_erp_px",
                          "clusters",
                          "seams",
                          "gnss",
                          "uncertainty",
                          "stages",
                          "workers",
                          "version"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["residual_erp_px"], report.residual_erp_px_mean);
  EXPECT_EQ(json["not_registered"][0]["name"], "IMG_0007 <script>.jpg");
  EXPECT_EQ(json["stages"][2]["cpu_s"], 92.4);
  EXPECT_EQ(json["seams"][1]["clusters"], nlohmann::json::array({1, 2}));
  EXPECT_EQ(json["gnss"]["outliers"].size(), 2U);
  EXPECT_EQ(json["uncertainty"]["worst"][0]["name"], "IMG_0003.jpg");
  EXPECT_NEAR(json["uncertainty"]["worst"][0]["position_sigma"], 3.742, 1e-3);
  EXPECT_THAT(std::string(json["uncertainty"]["frame"]), HasSubstr("absolute"));
  EXPECT_EQ(ReportJson(report), ReportJson(MadeUpReport(40, 3)));
}

TEST(ReportJson, TellsVerdictChecksModelsAndEveryImage) {
  JobReport report = MadeUpReport(40, 3);
  report.images[7].registered = false;
  const auto json = nlohmann::json::parse(ReportJson(report));
  EXPECT_EQ(json["verdict"]["level"], "doubtful");
  EXPECT_EQ(json["verdict"]["reasons"][0], report.verdict.reasons[0]);
  EXPECT_EQ(json["checks"][1]["name"], "gnss_clock");
  EXPECT_EQ(json["checks"][1]["level"], "doubtful");
  EXPECT_EQ(json["checks"][1]["value"], 0.83);
  EXPECT_EQ(json["each_model"][0]["registered"], 40);
  ASSERT_EQ(json["images"].size(), 40U);
  EXPECT_EQ(json["images"][3]["cluster"], report.images[3].cluster);
  EXPECT_EQ(json["images"][3]["observations"], report.images[3].observations);
  EXPECT_EQ(json["images"][3]["residual_px"], report.images[3].residual_px_mean);
  EXPECT_EQ(json["images"][3]["model"], 0);
  EXPECT_EQ(json["images"][7]["state"], "not_registered");
  EXPECT_FALSE(json["images"][7].contains("centre"));
  EXPECT_EQ(json["images"][20]["state"], "loose");
  EXPECT_EQ(json["gnss"]["contradicted"][0]["name"], "IMG_0020.jpg");
  EXPECT_NEAR(json["gnss"]["contradicted"][0]["east_m"], 22.0, 1e-9);
  EXPECT_NEAR(json["gnss"]["contradicted"][0]["distance_m"], std::hypot(22.0, 14.0), 1e-9);
  EXPECT_NEAR(
      json["uncertainty"]["relative"]["position_sigma_median_share_of_step"], 0.037 / 5.2, 1e-12);
  EXPECT_EQ(nlohmann::json::parse(ReportJson({}))["images"].size(), 0U);
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

TEST(ReportHtml, TellsWhichRungOfTheLadderWonHowManyPairs) {
  JobReport report = MadeUpReport(40, 3);
  report.pairs_of_rung = {};
  EXPECT_THAT(ReportHtml(report), Not(HasSubstr("Verified pairs")));
  report.pairs_of_rung[static_cast<size_t>(MatchRung::kLargest)] = 1200;
  report.pairs_of_rung[static_cast<size_t>(MatchRung::kPropagated)] = 3;
  const std::string html = ReportHtml(report);
  const size_t largest = html.find(CountText(1200) + "</td><td class=\"text\">by the features");
  const size_t propagated = html.find("<td>3</td><td class=\"text\">under the rotation");
  EXPECT_LT(largest, propagated);
  EXPECT_NE(propagated, std::string::npos);
  EXPECT_THAT(html, Not(HasSubstr("given to the job")));
}

TEST(ReportHtml, HasTheResidualInTheImageBesideTheAngle) {
  EXPECT_THAT(ReportHtml(MadeUpReport(40, 3)),
              HasSubstr("mean residual (rms 0.913; in the image 0.847)"));
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
  report.checks = {{hostile, 1.0, 0.5, hostile, CheckLevel::kBad, hostile}};
  report.verdict = {CheckLevel::kBad, {hostile}};
  report.models = 2;
  report.each_model.push_back({.gnss = {.reason = hostile}});
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

std::string FirstMap(const JobReport& report) {
  return TrajectoryMapSvg(report, MapFrames(report).front());
}

TEST(TrajectoryMap, ShowsEveryImageSeamAndOutlier) {
  const JobReport report = MadeUpReport(96, 5);
  const std::string map = FirstMap(report);
  EXPECT_EQ(CountOf(map, "<circle"), 95U);
  EXPECT_EQ(CountOf(map, "class=\"sym loose"), 1U);
  EXPECT_EQ(CountOf(map, "class=\"sym seam"), report.seams.size());
  EXPECT_EQ(CountOf(map, "class=\"sym seam unused"), 1U);
  EXPECT_EQ(CountOf(map, "class=\"sym outlier"), 2U);
  EXPECT_THAT(map, HasSubstr(">N</text>"));
  EXPECT_THAT(map, HasSubstr(">50 m</text>"));
  EXPECT_EQ(TrajectoryMapSvg(report, {.georeferenced = false, .models = {1}}), "");
}

TEST(TrajectoryMap, KeepsEveryMarkWithinItsFrameHoweverFarOffGnssIs) {
  JobReport report = MadeUpReport(96, 5);
  report.images[20].gnss_in_world = Eigen::Vector3d(3e6, -2e5, 9e3);
  report.images[60].gnss_in_world = Eigen::Vector3d(-40.0, 900.0, 0.0);
  ReportImage& missing = report.images.emplace_back();
  missing.name = "far <away>.jpg";
  missing.gnss_in_world = Eigen::Vector3d(-7e4, 1e3, 0.0);
  const std::string map = FirstMap(report);
  EXPECT_EQ(CountOf(map, "class=\"sym missing"), 1U);
  EXPECT_THAT(map, HasSubstr("far &lt;away&gt;.jpg"));
  double width = 0.0;
  double height = 0.0;
  ASSERT_EQ(
      std::sscanf(map.c_str() + map.find("viewBox"), "viewBox=\"0 0 %lf %lf", &width, &height), 2);
  size_t marks = 0;
  for (size_t at = map.find("translate("); at != std::string::npos;
       at = map.find("translate(", at + 1)) {
    double x = 0.0;
    double y = 0.0;
    ASSERT_EQ(std::sscanf(map.c_str() + at, "translate(%lf,%lf", &x, &y), 2);
    EXPECT_TRUE(x > 0.0 && x < width && y > 0.0 && y < height) << x << " " << y;
    ++marks;
  }
  EXPECT_GT(marks, 8U);
  // The street itself still fills most of the map.
  EXPECT_GT(height, 300.0);
}

TEST(TrajectoryMap, PutsGeoreferencedModelsIntoOneFrameAndOthersIntoTheirOwn) {
  JobReport report = MadeUpReport(60, 3);
  report.models = 3;
  report.gnss.num_inliers = 38;
  report.gnss.num_priors = 40;
  const ReportModel first = report.each_model.front();
  report.each_model = {first, {.images = 15}, first};
  report.each_model[0].images = 35;
  report.each_model[2].images = 10;
  for (size_t i = 0; i < 60; ++i) report.images[i].model = i < 35 ? 0 : i < 50 ? 1 : 2;
  const std::vector<MapFrame> frames = MapFrames(report);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].models, (std::vector<uint32_t>{0, 2}));
  EXPECT_EQ(frames[1].models, (std::vector<uint32_t>{1}));
  const std::string together = TrajectoryMapSvg(report, frames[0]);
  EXPECT_EQ(CountOf(together, "<title>IMG_"), 45U);
  EXPECT_EQ(CountOf(TrajectoryMapSvg(report, frames[1]), "<title>IMG_"), 15U);
  EXPECT_THAT(MapKeyHtml(report, frames[0], together), HasSubstr("model 2 (10)"));
  EXPECT_TRUE(IsBalanced(ReportHtml(report)));
  EXPECT_THAT(ReportHtml(report), HasSubstr("2 models that GNSS puts into one frame"));
  EXPECT_THAT(ReportHtml(report), HasSubstr("38 of 40 agree in model 0"));
}

TEST(ReportHtml, TellsTheUncertaintyOfEveryModelAndWhoseTheSummaryIs) {
  JobReport report = MadeUpReport(60, 3);
  EXPECT_THAT(ReportHtml(report), Not(HasSubstr("of model 0")));
  report.models = 2;
  report.each_model.push_back({.uncertainty = {.known = true, .position_median = 0.0042}});
  const std::string html = ReportHtml(report);
  EXPECT_THAT(html, HasSubstr("One standard deviation of poses of model 0, absolute"));
  EXPECT_THAT(html, HasSubstr("<td>0.037 m</td>"));
  EXPECT_THAT(html, HasSubstr("<td>0.0042 units</td>"));
  const auto json = nlohmann::json::parse(ReportJson(report));
  EXPECT_EQ(json["uncertainty"]["model"], 0);
  EXPECT_EQ(json["each_model"][0]["uncertainty"]["position_sigma_median"], 0.037);
  EXPECT_EQ(json["each_model"][1]["uncertainty"]["position_sigma_median"], 0.0042);
  EXPECT_EQ(json["each_model"][1]["uncertainty"]["unit"], "free");
}

TEST(MapKey, ListsWhatIsShownAndNothingElse) {
  JobReport report = MadeUpReport(96, 5);
  const auto key = [&] {
    const MapFrame frame = MapFrames(report).front();
    return MapKeyHtml(report, frame, TrajectoryMapSvg(report, frame));
  };
  for (const char* shown : {"cluster 4",
                            "in two clusters",
                            "placed loosely",
                            "switched off",
                            "without certificate",
                            "error ellipse",
                            "contradicted GNSS"})
    EXPECT_THAT(key(), HasSubstr(shown));
  for (const char* absent : {"doubtful seam", "bad seam", "seam that fits", "not registered, at"})
    EXPECT_THAT(key(), Not(HasSubstr(absent)));
  report.seams.clear();
  for (ReportImage& image : report.images) {
    image.cluster = 0;
    image.in_overlap = image.loose = image.gnss_outlier = false;
    image.uncertainty.reset();
  }
  EXPECT_EQ(key(), "");
}

TEST(MapKey, TellsTenModelsApartAndSaysWhereLooksRepeat) {
  JobReport report = MadeUpReport(48, 3);
  const ReportModel model = report.each_model.front();
  report.models = 12;
  report.each_model.assign(12, model);
  for (size_t i = 0; i < 48; ++i) report.images[i].model = static_cast<uint32_t>(i / 4);
  const MapFrame frame = MapFrames(report).front();
  const std::string map = TrajectoryMapSvg(report, frame);
  const std::string key = MapKeyHtml(report, frame, map);
  EXPECT_THAT(key, HasSubstr("<i class=\"k1\"></i>model 1 "));
  EXPECT_THAT(key, HasSubstr("<i class=\"k1 hollow\"></i>model 6 "));
  EXPECT_THAT(key, Not(HasSubstr("model 10 ")));
  EXPECT_THAT(key, HasSubstr("and 2 smaller models, in the same colours again"));
  EXPECT_THAT(map, HasSubstr("k1 hollow"));
}

TEST(MapKey, SaysHowManyMarksAreNotDrawn) {
  const auto key = [](const JobReport& report) {
    const MapFrame frame = MapFrames(report).front();
    return MapKeyHtml(report, frame, TrajectoryMapSvg(report, frame));
  };
  EXPECT_THAT(key(MadeUpReport(96, 5)), Not(HasSubstr("not drawn")));
  JobReport report = MadeUpReport(6001, 20);
  EXPECT_THAT(key(report), HasSubstr("4,000 of 6,001 panoramas with a pose are not drawn"));
  for (size_t i = 0; i < 800; ++i) report.images[i].gnss_outlier = true;
  ReportImage missing;
  missing.gnss_in_world = Eigen::Vector3d::Zero();
  report.images.insert(report.images.end(), 700, missing);
  EXPECT_THAT(key(report), HasSubstr("200 of 700 panoramas without a pose are not drawn"));
  EXPECT_THAT(key(report), HasSubstr("of 80"));
  EXPECT_THAT(key(report), HasSubstr("contradicted GNSS positions are not drawn"));
}

TEST(MapSymbols, HaveShapesOfTheirOwn) {
  const auto drawn = [](MapSymbol symbol) {
    const std::string svg = DrawnSymbol(symbol, {0, 0}, 5.0, "", "");
    return svg.substr(svg.find(" d="));
  };
  std::set<std::string> shapes;
  for (const MapSymbol symbol : {MapSymbol::kLoose,
                                 MapSymbol::kMissing,
                                 MapSymbol::kContradicted,
                                 MapSymbol::kSeamGood,
                                 MapSymbol::kSeamUnknown,
                                 MapSymbol::kSeamDoubtful,
                                 MapSymbol::kSeamBad,
                                 MapSymbol::kSeamUnused})
    EXPECT_TRUE(shapes.insert(drawn(symbol)).second) << SymbolClass(symbol);
}

TEST(ColorsOfClusters, DifferAcrossEverySeam) {
  JobReport report = MadeUpReport(200, 11);
  report.seams.push_back({.cluster_a = 0, .cluster_b = 5});  // the same colour in turn
  const std::vector<int> colors = ColorsOfClusters(report);
  ASSERT_EQ(colors.size(), 11U);
  for (const ReportSeam& seam : report.seams)
    EXPECT_NE(colors[seam.cluster_a], colors[seam.cluster_b]) << seam.cluster_a;
}

TEST(ReportHtml, DrawsEllipsesOfAllThatIsKnownAndCutsTheLargest) {
  JobReport report = MadeUpReport(48, 5);
  const std::string map = FirstMap(report);
  EXPECT_EQ(CountOf(map, "<ellipse"), 47U);
  EXPECT_EQ(CountOf(map, "sigma cut"), 1U);
  EXPECT_THAT(map, HasSubstr("ellipses: one sigma, x "));
  // Twice as far along x as along y, flat on the page.
  EXPECT_EQ(CountOf(map, "rotate(0)"), 47U);
  for (ReportImage& image : report.images) image.uncertainty.reset();
  EXPECT_THAT(FirstMap(report), Not(HasSubstr("ellipse")));
}

TEST(ReportHtml, KeepsTheLeastCertainImageOfALongStreet) {
  EXPECT_EQ(CountOf(FirstMap(MadeUpReport(2000, 20)), "sigma cut"), 1U);
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

TEST(ReportHtml, SaysTheVerdictFirstThenWarningsThenFigures) {
  JobReport report = MadeUpReport(40, 3);
  const std::string html = ReportHtml(report);
  const size_t verdict = html.find("Verdict: doubtful");
  const size_t warnings = html.find("<h2>Warnings");
  ASSERT_NE(verdict, std::string::npos);
  EXPECT_LT(verdict, warnings);
  EXPECT_LT(warnings, html.find("class=\"cards\""));
  EXPECT_THAT(html, HasSubstr("<li>the GNSS clock is &lt;late&gt; by 0.8 s</li>"));
  // The doubtful check is above the good one, each with what it is held to.
  EXPECT_LT(html.find("gnss_<wbr/>clock"), html.find("images_<wbr/>registered"));
  EXPECT_THAT(html, HasSubstr("<td>0.83 s</td><td>≤ 0.2 s</td>"));
  EXPECT_THAT(html, HasSubstr("<td>100 %</td><td>≥ 95 %</td>"));
  EXPECT_THAT(html, HasSubstr("<td>5</td><td></td>")) << "no limit is known";
  const auto checks = nlohmann::json::parse(ReportJson(report))["checks"];
  EXPECT_EQ(checks[0]["limit_is"], "at_least");
  EXPECT_EQ(checks[1]["limit_is"], "at_most");
  EXPECT_TRUE(checks[2]["limit"].is_null());
  EXPECT_TRUE(checks[2]["limit_is"].is_null());
  report.verdict = {};
  EXPECT_THAT(ReportHtml(report), HasSubstr("nothing that speaks against the model"));
}

TEST(ReportHtml, TellsHowFarContradictedPositionsAreOffEastNorthAndUp) {
  const std::string html = ReportHtml(MadeUpReport(96, 5));
  EXPECT_THAT(html, HasSubstr("2 contradicted positions"));
  EXPECT_THAT(html,
              HasSubstr("<td class=\"text\">IMG_0020.jpg</td><td>22</td><td>14</td><td>0</td>"
                        "<td>26.1</td>"));
}

TEST(ReportHtml, MakesOneLineOfWarningsAndReasonsOfAKind) {
  JobReport report = MadeUpReport(40, 3);
  report.warnings.clear();
  report.not_registered.clear();
  for (int i = 0; i < 30; ++i) {
    report.warnings.push_back("row " + std::to_string(i) + " of gnss.csv has no image");
    report.not_registered.push_back({"stop_" + std::to_string(i) + ".jpg", "no pair could start"});
  }
  const std::string html = ReportHtml(report);
  EXPECT_EQ(CountOf(html, "of gnss.csv has no image"), 1U);
  EXPECT_THAT(html, HasSubstr("row 0 of gnss.csv has no image (and 29 more of this kind)"));
  EXPECT_EQ(CountOf(html, "no pair could start"), 1U);
  EXPECT_THAT(html, HasSubstr("<td>30</td><td class=\"text\">no pair could start"));
  const auto json = nlohmann::json::parse(ReportJson(report));
  ASSERT_EQ(json["warnings"].size(), 1U);
  EXPECT_EQ(json["warnings"][0], "row 0 of gnss.csv has no image (and 29 more of this kind)");
  EXPECT_EQ(json["warnings_in_full"].size(), 30U);
}

TEST(ReportHtml, GivesPrecisionAsShareOfPathAndStepToo) {
  EXPECT_THAT(ReportHtml(MadeUpReport(40, 3)),
              HasSubstr("178 ppm of a path of 208 m, 0.71 % of a step of 5.2 m"));
}

TEST(ReportHtml, DrawsNoLineAndNamesNoPathWhereNothingTellsTheOrder) {
  JobReport report = MadeUpReport(40, 3);
  EXPECT_EQ(CountOf(ReportHtml(report), "<polyline class=\"path\""), 1U);
  report.paths.clear();
  report.each_model[0].is_in_order = false;
  report.each_model[0].path_length = 0.0;
  const std::string html = ReportHtml(report);
  EXPECT_THAT(html, Not(HasSubstr("<polyline class=\"path\"")));
  EXPECT_THAT(html, HasSubstr(": 0.71 % of the distance to the nearest panorama, 5.2 m"));
  EXPECT_THAT(html, Not(HasSubstr("of a step")));
  const auto json = nlohmann::json::parse(ReportJson(report));
  EXPECT_EQ(json["uncertainty"]["relative"]["in_order"], false);
  EXPECT_TRUE(json["uncertainty"]["relative"]["path_length"].is_null());
  EXPECT_TRUE(json["uncertainty"]["relative"]["position_sigma_median_share_of_path"].is_null());
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
