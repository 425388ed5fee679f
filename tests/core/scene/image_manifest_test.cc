// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/image_manifest.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(ImageManifest, FindsAnImageByItsId) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < 3; ++i) {
    manifest.images.push_back({.id = ImageId(i), .name = std::to_string(i) + ".jpg"});
  }
  EXPECT_EQ(manifest.At(ImageId(2)).name, "2.jpg");
}

}  // namespace
}  // namespace orbweave
