// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_standing_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/build_job_report.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

/// 30 images, every pair verified; those of two images below `standing` are pure rotations.
JobResults BusStop(uint32_t standing) {
  JobResults results;
  for (uint32_t i = 0; i < 30; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    for (uint32_t k = 0; k < i; ++k) {
      results.view_graph.edges.push_back({ImageId(k), ImageId(i)});
      const TwoViewKind kind = i < standing ? TwoViewKind::kPureRotation : TwoViewKind::kGeneral;
      results.view_graph.edge_kinds.push_back(static_cast<uint8_t>(kind));
    }
  }
  return results;
}

TEST(CheckStandingCamera, TellsThatTheCameraNeverMoved) {
  const JobReport report = BuildJobReport(BusStop(30));
  const auto check = std::ranges::find(report.checks, "standing_camera", &CrossCheck::name);
  ASSERT_NE(check, report.checks.end());
  EXPECT_EQ(check->value, 30.0);
  EXPECT_EQ(check->level, CheckLevel::kDoubtful);
  EXPECT_THAT(check->sentence, HasSubstr("did not move between 30 panoramas"));
  ASSERT_EQ(report.not_registered.size(), 30U);
  for (const Exclusion& image : report.not_registered)
    EXPECT_THAT(image.reason, HasSubstr("the camera did not move: 29 of its 29"));
}

TEST(CheckStandingCamera, SaysNothingOfACameraThatMoves) {
  const JobResults moving = BusStop(0);
  EXPECT_FALSE(CheckStandingCamera(moving, BuildJobReport(moving).images).has_value());
  EXPECT_FALSE(CheckStandingCamera({}, {}).has_value());
}

TEST(CheckStandingCamera, AStopThatAModelHoldsIsNoReasonForDoubt) {
  JobResults results = BusStop(28);
  AdjustedModel& model = results.models.emplace_back();
  for (uint32_t i = 0; i < 30; ++i) model.images[ImageId(i)] = {};
  EXPECT_FALSE(CheckStandingCamera(results, BuildJobReport(results).images).has_value());
  model.images.erase(ImageId(3));
  EXPECT_TRUE(CheckStandingCamera(results, BuildJobReport(results).images).has_value());
}

}  // namespace
}  // namespace orbweave
