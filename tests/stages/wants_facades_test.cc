// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/list_extractions/wants_facades.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

ImageManifest Street(uint32_t count, double spacing_m) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < count; ++i) {
    manifest.images.push_back({.id = ImageId(i)});
    manifest.images.back().prior.position_in_enu = Eigen::Vector3d(spacing_m * i, 0.0, 0.0);
  }
  return manifest;
}

TEST(WantsFacades, WherePanoramasAreFarApart) {
  EXPECT_FALSE(WantsFacades(Street(20, 2.5), {}));
  EXPECT_TRUE(WantsFacades(Street(20, 8.0), {}));
}

TEST(WantsFacades, NotWherePositionsAreNothingButNoise) {
  ImageManifest manifest = Street(11, 0.0);
  for (uint32_t i = 0; i < 11; ++i) {
    const double angle = 2.4 * i;
    manifest.images[i].prior.position_in_enu =
        Eigen::Vector3d(10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0);
  }
  EXPECT_FALSE(WantsFacades(manifest, {}));
  for (ImageRecord& image : manifest.images) image.prior.horizontal_sigma_m = 1.0;
  EXPECT_TRUE(WantsFacades(manifest, {}));
}

TEST(WantsFacades, ForMostImagesAndWhateverTheirOrder) {
  ImageManifest manifest = Street(20, 8.0);
  for (uint32_t i = 0; i < 12; ++i)
    manifest.images[i].prior.position_in_enu = Eigen::Vector3d(-2.0 * (7 * i % 12), 0.0, 0.0);
  EXPECT_FALSE(WantsFacades(manifest, {}));
}

TEST(WantsFacades, NotWhereNothingIsKnown) {
  EXPECT_FALSE(WantsFacades({}, {}));
  ImageManifest manifest = Street(20, 8.0);
  for (ImageRecord& image : manifest.images) image.prior.position_in_enu.reset();
  EXPECT_FALSE(WantsFacades(manifest, {}));
}

TEST(WantsFacades, AsTheOptionSays) {
  EXPECT_TRUE(WantsFacades(Street(20, 2.5), {.facades = UseFacades::kOn}));
  EXPECT_FALSE(WantsFacades(Street(20, 8.0), {.facades = UseFacades::kOff}));
}

}  // namespace
}  // namespace orbweave
