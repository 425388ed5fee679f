// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/features.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(Features, GiveTheBearingOfAKeypoint) {
  Features features;
  features.camera = {.width_px = 400, .height_px = 200};
  features.keypoints = {{.x_px = 200.0F, .y_px = 100.0F}, {.x_px = 300.0F, .y_px = 100.0F}};
  EXPECT_EQ(features.size(), 2U);
  EXPECT_LT((features.Bearing(0) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((features.Bearing(1) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

TEST(Features, KeepDescriptorsInRows) {
  Features features;
  features.descriptors.assign(3 * kDescriptorSize, 0);
  features.descriptors[2 * kDescriptorSize] = 77;
  EXPECT_EQ(features.Descriptor(2)[0], 77);
  EXPECT_EQ(features.Descriptor(1) - features.Descriptor(0), kDescriptorSize);
}

}  // namespace
}  // namespace orbweave
