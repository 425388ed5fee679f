// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/positions_by_motion.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

/// A street of 30 images 8 m and one second apart, with a corner in the middle.
class Street {
 public:
  explicit Street(double noise_m, uint32_t size = 30) {
    Random random(11);
    Eigen::Vector3d centre(100.0, -20.0, 5.0);
    for (uint32_t i = 0; i < size; ++i) {
      truth.push_back(centre);
      ImageRecord& image = manifest.images.emplace_back();
      image.id = ImageId(i);
      image.capture_time_s = 1.7e9 + i;
      image.prior.position_in_enu =
          centre + noise_m * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
      image.prior.horizontal_sigma_m = 2.0;
      image.prior.vertical_sigma_m = 4.0;
      centre += i < size / 2 ? Eigen::Vector3d(8.0, 0.0, 0.0) : Eigen::Vector3d(0.0, 8.0, 0.0);
    }
  }
  void Move(uint32_t image, const Eigen::Vector3d& by) {
    *manifest.images[image].prior.position_in_enu += by;
  }
  [[nodiscard]] double Error(const std::vector<PositionByMotion>& positions, uint32_t image) const {
    return (*positions[image].prior.position_in_enu - truth[image]).norm();
  }
  [[nodiscard]] bool IsUnchangedBy(const std::vector<PositionByMotion>& positions) const {
    for (const ImageRecord& image : manifest.images) {
      const PosePrior& prior = positions[image.id.value].prior;
      if (positions[image.id.value].is_of_drive ||
          prior.position_in_enu != image.prior.position_in_enu ||
          prior.horizontal_sigma_m != image.prior.horizontal_sigma_m)
        return false;
    }
    return true;
  }

  ImageManifest manifest{};
  std::vector<Eigen::Vector3d> truth{};
};

TEST(PositionsByMotion, APositionThatJumpsIsTakenForWhereTheDriveWas) {
  Street street(0.5);
  street.Move(7, {-30.0, 6.0, 0.0});
  street.Move(8, {25.0, 14.0, 0.0});
  street.Move(22, {3.0, 40.0, 0.0});
  const std::vector<PositionByMotion> positions = PositionsByMotion(street.manifest);
  for (const uint32_t image : {7U, 8U, 22U}) {
    EXPECT_LT(street.Error(positions, image), 4.0) << image;
    EXPECT_LT(positions[image].prior.horizontal_sigma_m, 5.0) << image;
    EXPECT_TRUE(positions[image].is_of_drive) << image;
  }
  EXPECT_LT(street.Error(positions, 10), 1.5);
}

TEST(PositionsByMotion, AnImageWithoutAPositionGetsOne) {
  Street street(0.5);
  street.manifest.images[20].prior.position_in_enu.reset();
  const std::vector<PositionByMotion> positions = PositionsByMotion(street.manifest);
  ASSERT_TRUE(positions[20].prior.position_in_enu);
  EXPECT_LT(street.Error(positions, 20), 2.0);
}

TEST(PositionsByMotion, AnImageWithoutATimeKeepsItsPositionAndNoOtherDoes) {
  Street street(0.5);
  street.Move(7, {-30.0, 6.0, 0.0});
  street.manifest.images[20].capture_time_s.reset();
  const std::vector<PositionByMotion> positions = PositionsByMotion(street.manifest);
  EXPECT_LT(street.Error(positions, 7), 4.0);
  EXPECT_FALSE(positions[20].is_of_drive);
  EXPECT_EQ(positions[20].prior.position_in_enu, street.manifest.images[20].prior.position_in_enu);
}

TEST(PositionsByMotion, TheLastPositionOfADriveIsDoubtedNotBelieved) {
  Street street(0.5, 6);
  street.Move(5, {25.0, 20.0, 0.0});
  const std::vector<PositionByMotion> positions = PositionsByMotion(street.manifest);
  for (uint32_t i = 0; i < 6; ++i)
    EXPECT_LT(street.Error(positions, i), 4.0 * positions[i].prior.horizontal_sigma_m) << i;
}

TEST(PositionsByMotion, LeavesWhatItCannotJudge) {
  Street without_times(1.0);
  for (size_t i = 4; i < 30; ++i) without_times.manifest.images[i].capture_time_s.reset();
  EXPECT_TRUE(without_times.IsUnchangedBy(PositionsByMotion(without_times.manifest)));
  const Street few(1.0, 4);
  EXPECT_TRUE(few.IsUnchangedBy(PositionsByMotion(few.manifest)));
  Street out_of_order(1.0);
  Random random(5);
  for (ImageRecord& image : out_of_order.manifest.images)
    image.capture_time_s = random.Uniform(0.0, 60.0);
  EXPECT_TRUE(out_of_order.IsUnchangedBy(PositionsByMotion(out_of_order.manifest)));
  EXPECT_TRUE(PositionsByMotion({}).empty());
}

TEST(PositionsByMotion, LongPausesTellNothingOfTheOthers) {
  Street street(0.5);
  for (ImageRecord& image : street.manifest.images) image.capture_time_s = 60.0 * image.id.value;
  const std::vector<PositionByMotion> positions = PositionsByMotion(street.manifest);
  for (uint32_t i = 0; i < 30; ++i) {
    EXPECT_FALSE(positions[i].is_of_drive) << i;
    EXPECT_LT(
        (*positions[i].prior.position_in_enu - *street.manifest.images[i].prior.position_in_enu)
            .norm(),
        0.1);
  }
}

/// Law: drives do not know of each other.
TEST(PositionsByMotion, TwoDrivesAreWhatEachIs) {
  const Street alone(1.0);
  Street both(1.0);
  for (size_t i = 0; i < 30; ++i) {
    ImageRecord image = both.manifest.images[i];
    image.id = ImageId(static_cast<uint32_t>(30 + i));
    image.drive = 1;
    *image.prior.position_in_enu += Eigen::Vector3d(3.0, 1.0, 40.0);
    both.manifest.images.push_back(image);
  }
  const std::vector<PositionByMotion> of_one = PositionsByMotion(alone.manifest);
  const std::vector<PositionByMotion> of_both = PositionsByMotion(both.manifest);
  for (size_t i = 0; i < 30; ++i) {
    EXPECT_EQ(of_one[i].prior.position_in_enu, of_both[i].prior.position_in_enu);
    EXPECT_LT((*of_both[30 + i].prior.position_in_enu - *of_both[i].prior.position_in_enu -
               Eigen::Vector3d(3.0, 1.0, 40.0))
                  .norm(),
              1e-2);
  }
}

/// A camera at 8 m/s is anywhere within 8 m at a time in whole seconds.
void KnowWholeSecondsOnly(Street& street) {
  for (ImageRecord& image : street.manifest.images)
    image.capture_time_s =
        std::floor(*image.capture_time_s + (image.id.value % 3 == 0 ? 0.9 : 0.0));
}

TEST(PositionsByMotion, ExactPositionsAreNotSmoothedToWholeSeconds) {
  Street street(0.2);
  KnowWholeSecondsOnly(street);
  const std::vector<PositionByMotion> positions = PositionsByMotion(street.manifest);
  for (uint32_t i = 0; i < 30; ++i) {
    const double sigma_m = positions[i].prior.horizontal_sigma_m;
    const bool is_corner = i == 15;  // which is no motion of a carrier
    EXPECT_LT(street.Error(positions, i), is_corner ? 3.0 : 1.0) << i;
    EXPECT_LT(street.Error(positions, i), 3.0 * sigma_m) << i;
    EXPECT_GT(sigma_m, 1.0) << i;
  }
}

TEST(PositionsByMotion, APositionThatJumpsIsFoundByWholeSeconds) {
  Street street(0.5);
  KnowWholeSecondsOnly(street);
  street.Move(7, {-30.0, 6.0, 0.0});
  street.Move(22, {3.0, 40.0, 0.0});
  const std::vector<PositionByMotion> positions = PositionsByMotion(street.manifest);
  for (const uint32_t image : {7U, 22U}) {
    EXPECT_LT(street.Error(positions, image), 9.0) << image;
    EXPECT_LT(street.Error(positions, image), 3.0 * positions[image].prior.horizontal_sigma_m);
  }
}

}  // namespace
}  // namespace orbweave
