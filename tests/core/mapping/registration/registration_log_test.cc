// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/registration_log.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(ReasonOf, SaysHowManyPointsAgreed) {
  EXPECT_EQ(ReasonOf({.num_attempts = 2, .best_inliers = 12, .needed_inliers = 20}, 20),
            "12 of 20 needed points agree");
}

TEST(ReasonOf, SaysHowManyPointsWereSeen) {
  EXPECT_EQ(ReasonOf({.best_visible = 7}, 30), "sees 7 of 30 needed reconstructed points");
}

TEST(ReasonOf, NeverSaysThatMoreThanEnoughIsTooLittle) {
  EXPECT_EQ(ReasonOf({.num_attempts = 2, .best_inliers = 17, .needed_inliers = 10}, 20),
            "no pair of its images could start a reconstruction");
  const std::string reason = ReasonOf({.best_visible = 545}, 20);
  EXPECT_TRUE(reason.starts_with("sees 545 reconstructed points")) << reason;
}

TEST(ReasonOf, SaysThatPositionsSpokeAgainstIt) {
  const std::string reason = ReasonOf({.best_inliers = 17, .contradicted = true}, 20);
  EXPECT_NE(reason.find("17 points put it where its GNSS position"), std::string::npos) << reason;
  RegistrationLog log = {{.contradicted = true}};
  ResetAttempts(log);
  EXPECT_FALSE(log[0].contradicted) << "it is to be tried anew";
}

TEST(ReasonOf, SaysThatPairsSpokeAgainstIt) {
  const std::string reason =
      ReasonOf({.best_inliers = 40, .obstacle = RegistrationObstacle::kPairs}, 20);
  EXPECT_NE(reason.find("strong pairs contradict where 40 points put it"), std::string::npos);
}

TEST(ReasonOf, SaysThatPointsDidNotTellHowFarItIs) {
  const std::string reason =
      ReasonOf({.best_inliers = 15, .obstacle = RegistrationObstacle::kLength}, 20);
  EXPECT_NE(reason.find("15 points agree, but do not tell how far"), std::string::npos);
  RegistrationLog log = {{.obstacle = RegistrationObstacle::kLength}};
  ResetAttempts(log);
  EXPECT_EQ(log[0].obstacle, RegistrationObstacle::kNone) << "it is to be tried anew";
}

TEST(ReasonOf, SaysThatPairsDidNotTellHowFarItIs) {
  EXPECT_EQ(ReasonOf({.num_attempts = 1, .obstacle = RegistrationObstacle::kUnheld}, 20),
            "its pairs say in which direction it lies from the others, but not how far");
  EXPECT_EQ(
      ReasonOf(
          {.best_inliers = 12, .needed_inliers = 20, .obstacle = RegistrationObstacle::kUnheld},
          20),
      "12 of 20 needed points agree");
}

TEST(ReasonOf, SaysThatTheImageWasTakenOutOfAModel) {
  EXPECT_NE(ReasonOf({.best_visible = 300, .loss = RegistrationLoss::kCut}, 20).find("was cut off"),
            std::string::npos);
  EXPECT_NE(ReasonOf({.best_visible = 300, .loss = RegistrationLoss::kScale}, 20)
                .find("scale of its own"),
            std::string::npos);
}

TEST(ReasonOf, SaysThatNothingStarted) {
  EXPECT_EQ(ReasonOf({}, 20), "no pair of its images could start a reconstruction");
}

TEST(ReasonOf, SaysThatTheImageWasLostAgain) {
  EXPECT_EQ(ReasonOf({.num_attempts = 1,
                      .best_inliers = 40,
                      .needed_inliers = 20,
                      .loss = RegistrationLoss::kPoints},
                     20),
            "lost its points again in the adjustment");
}

}  // namespace
}  // namespace orbweave
