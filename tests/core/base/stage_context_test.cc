// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/stage_context.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(StageContext, GoesOnUntilAskedToStop) {
  std::stop_source stop;
  const StageContext context{.stop = stop.get_token()};
  EXPECT_TRUE(context.CheckStop().ok());
  stop.request_stop();
  EXPECT_EQ(context.CheckStop().code(), absl::StatusCode::kCancelled);
  EXPECT_TRUE(StageContext{}.CheckStop().ok());
}

TEST(StageContext, ReportsToWhoListens) {
  Progress heard;
  const StageContext context{.report = [&](const Progress& progress) { heard = progress; }};
  context.Report(3, 10, "images");
  EXPECT_EQ(heard.done, 3U);
  EXPECT_EQ(heard.total, 10U);
  EXPECT_EQ(heard.unit, "images");
  StageContext{}.Report(1, 2, "nobody listens");
}

}  // namespace
}  // namespace orbweave
