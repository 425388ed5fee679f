// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/dense_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/report/dense_report_html.h"
#include "core/report/dense_report_json.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

DenseReport MadeUp() {
  return {.title = "a <street>",
          .num_points = 12,
          .maps = {{"a.jpg", 0.5}, {"b&c.jpg", 0.25}, {"\xff.jpg", 0.0}},
          .by_sigma = {1, 2, 3, 4, 2, 0, 0, 0},
          .by_views = {0, 0, 7, 5, 0, 0, 0, 0, 0},
          .omitted = {{"\xff.jpg", "all <sky>"}},
          .elapsed_s = 10.0,
          .stages = {{.name = "estimate_depths", .wall_s = 8.0, .cpu_s = 6.0}}};
}

TEST(DenseReport, KeepsNumbersInItsJson) {
  const auto json = nlohmann::json::parse(DenseReportJson(MadeUp()));
  EXPECT_EQ(json["points"], 12);
  EXPECT_EQ(json["panoramas"], 3);
  EXPECT_DOUBLE_EQ(json["coverage"], 0.25);
  EXPECT_DOUBLE_EQ(json["cpu_s"], 6.0);
  EXPECT_EQ(json["sigma_below_thousandths"].size() + 1, json["points_by_sigma"].size());
  EXPECT_EQ(json["without_depth"][0]["reason"], "all <sky>");
}

TEST(DenseReport, PageHasPicturesReasonsAndNothingUnescaped) {
  const std::string page = DenseReportHtml(
      MadeUp(),
      {.from_above_png = "PNG", .pixel = 0.08, .depths = {{.image = "b&c.jpg", .jpeg = "JPEG"}}});
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,UE5H\""));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,SlBFRw==\""));
  EXPECT_THAT(page, HasSubstr("b&amp;c.jpg"));
  EXPECT_THAT(page, HasSubstr("all &lt;sky&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<street>")));
  EXPECT_THAT(page, Not(HasSubstr("\xff")));
  EXPECT_THAT(page, HasSubstr("estimate_depths"));
  EXPECT_THAT(page, Not(HasSubstr("http")));
}

TEST(DenseReport, OfNothingIsAPage) {
  const std::string page = DenseReportHtml(DenseReport{}, DensePictures{});
  EXPECT_THAT(page, HasSubstr("There is no point."));
}

}  // namespace
}  // namespace orbweave
