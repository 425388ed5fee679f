// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_look_alikes.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(CheckLookAlikes, CountsPairsThatWereToldApart) {
  JobResults results;
  const ImagePair pair{ImageId(0), ImageId(20)};
  results.view_graph.dropped = {{pair, "", DropCause::kSequence},
                                {pair, "", DropCause::kSequence},
                                {pair, "", DropCause::kGnss},
                                {pair, "", DropCause::kTriplets}};
  const CrossCheck check = CheckLookAlikes(results);
  EXPECT_EQ(check.name, "look_alikes");
  EXPECT_EQ(check.value, 3.0);
  EXPECT_EQ(check.level, CheckLevel::kGood);
  EXPECT_NE(check.sentence.find("2 told apart by the sequence of their drive, 1 by GNSS"),
            std::string::npos)
      << check.sentence;
  EXPECT_EQ(CheckLookAlikes({}).value, 0.0);
}

}  // namespace
}  // namespace orbweave
