// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/choose_local_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr uint32_t kImages = 12;

/// East, north, up: x to the right, y down, z where the panorama looks.
Eigen::Quaterniond LooksTowards(double heading_deg) {
  const double h = heading_deg * kDegree;
  Eigen::Matrix3d enu_from_cam;
  enu_from_cam << std::cos(h), 0.0, std::sin(h),  //
      -std::sin(h), 0.0, std::cos(h),             //
      0.0, -1.0, 0.0;
  return Eigen::Quaterniond(enu_from_cam).conjugate();
}

/// Level panoramas on a way that bends, 2 m apart, headed as a vehicle is that turns about; in a
/// world that lies anyhow.
struct Way {
  Reconstruction model{};
  ImageManifest manifest{};
  std::map<ImageId, Vector3d> true_in_enu{};

  explicit Way(uint64_t seed) {
    Random random(seed);
    const Rigid3 world_from_enu{testing::RandomRotation(random), {5.0, -3.0, 8.0}};
    Vector3d centre = Vector3d::Zero();
    for (uint32_t i = 0; i < kImages; ++i) {
      const double heading_deg = 170.0 + 5.0 * i;
      const Rigid3 cam_from_enu = Rigid3::FromCentre(LooksTowards(heading_deg), centre);
      model.images[ImageId(i)].cam_from_world = cam_from_enu * world_from_enu.Inverse();
      true_in_enu[ImageId(i)] = centre;
      ImageRecord& record = manifest.images.emplace_back();
      record.id = ImageId(i);
      record.prior.heading_deg = std::remainder(heading_deg + 3.0 * random.Normal(), 360.0);
      centre += 2.0 * Vector3d(std::sin(heading_deg * kDegree), std::cos(heading_deg * kDegree), 0);
    }
  }

  /// Between the way from the first image to the last in the local frame and on earth.
  [[nodiscard]] double TurnedBy_deg() const {
    const Sim3 local_from_world = ChooseLocalFrame(model, manifest);
    const auto centre = [&](uint32_t i) {
      return local_from_world * model.images.at(ImageId(i)).cam_from_world.Centre();
    };
    return AngleBetween(centre(kImages - 1) - centre(0),
                        true_in_enu.at(ImageId(kImages - 1)) - true_in_enu.at(ImageId(0))) /
           kDegree;
  }
};

TEST(ChooseLocalFrame, IsUprightWithStepsOfOne) {
  for (uint64_t seed = 1; seed < 6; ++seed) {
    const Way way(seed);
    const Sim3 frame = ChooseLocalFrame(way.model, way.manifest);
    const auto& images = way.model.images;
    const Vector3d first = frame * images.at(ImageId(0)).cam_from_world.Centre();
    const Vector3d second = frame * images.at(ImageId(1)).cam_from_world.Centre();
    EXPECT_LT(first.norm(), 1e-9);
    EXPECT_NEAR((second - first).norm(), 1.0, 1e-6);
    EXPECT_NEAR(second.z(), 0.0, 1e-6);
  }
}

TEST(ChooseLocalFrame, LooksNorthWhereHeadingsSayIt) {
  for (uint64_t seed = 1; seed < 6; ++seed) EXPECT_LT(Way(seed).TurnedBy_deg(), 4.0) << seed;
}

TEST(ChooseLocalFrame, DoesNotHeedACompassBesideIron) {
  Way way(1);
  for (uint32_t i = 0; i < 4; ++i) way.manifest.images[i].prior.heading_deg = 75.0 * i;
  EXPECT_LT(way.TurnedBy_deg(), 4.0);
}

TEST(ChooseLocalFrame, DoesNotBelieveHeadingsThatDoNotAgree) {
  Way some(1);
  for (uint32_t i = 3; i < kImages; ++i) some.manifest.images[i].prior.heading_deg.reset();
  EXPECT_LT(some.TurnedBy_deg(), 6.0);
  Way none = some;
  none.manifest.images[2].prior.heading_deg.reset();  // two
  Way unknown = none;
  for (ImageRecord& image : unknown.manifest.images) image.prior.heading_deg.reset();
  EXPECT_EQ(none.TurnedBy_deg(), unknown.TurnedBy_deg());
  Way scattered(1);
  for (uint32_t i = 0; i < 8; ++i) scattered.manifest.images[i].prior.heading_deg = 45.0 * i;
  EXPECT_EQ(scattered.TurnedBy_deg(), unknown.TurnedBy_deg());
}

}  // namespace
}  // namespace orbweave
