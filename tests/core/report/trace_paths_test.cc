// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/trace_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/base/random.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A job whose images stand at `places`, in one model and drive.
struct Job {
  ImageManifest manifest{};
  JobReport report{};

  explicit Job(const std::vector<Eigen::Vector3d>& places) {
    report.each_model.resize(1);
    for (const Eigen::Vector3d& place : places) {
      const auto number = static_cast<uint32_t>(report.images.size());
      manifest.images.push_back({.id = ImageId(number)});
      report.images.push_back({.registered = true, .centre_in_world = place});
    }
  }
  void PutIntoDrive(uint32_t image, uint32_t drive) {
    manifest.images[image].drive = report.images[image].drive = drive;
  }
  std::vector<std::vector<uint32_t>> Paths() {
    TracePaths(manifest, report);
    std::vector<std::vector<uint32_t>> paths;
    for (const ReportPath& path : report.paths) paths.push_back(path.images);
    return paths;
  }
  const ReportModel& model() { return report.each_model.front(); }
};

std::vector<Eigen::Vector3d> Street(uint32_t num_images, double step = 3.0) {
  std::vector<Eigen::Vector3d> places;
  for (uint32_t i = 0; i < num_images; ++i) places.emplace_back(step * i, 0.0, 0.0);
  return places;
}

std::vector<Eigen::Vector3d> Shuffled(std::vector<Eigen::Vector3d> places, uint64_t seed) {
  Random random(seed);
  for (size_t i = places.size(); i > 1; --i)
    std::swap(places[i - 1], places[random.Index(static_cast<uint32_t>(i))]);
  return places;
}

TEST(TracePaths, FollowTimesWhereNamesAreInAnotherOrder) {
  Job job(Street(6));
  const std::vector<double> times_s = {50, 10, 40, 0, 30, 20};
  for (uint32_t i = 0; i < 6; ++i) {
    job.manifest.images[i].capture_time_s = times_s[i];
    job.report.images[i].centre_in_world.x() = times_s[i];
  }
  EXPECT_THAT(job.Paths(), ElementsAre(ElementsAre(3, 1, 5, 4, 2, 0)));
  EXPECT_DOUBLE_EQ(job.model().path_length, 50.0);
  EXPECT_DOUBLE_EQ(job.model().step_median, 10.0);
  EXPECT_TRUE(job.model().is_in_order);
}

TEST(TracePaths, EndAtGapsAndAtTheEndsOfDrivesAndModels) {
  std::vector<Eigen::Vector3d> places = Street(20);
  for (size_t i = 8; i < 20; ++i) places[i].x() += 300.0;
  Job job(places);
  for (uint32_t i = 14; i < 20; ++i) job.PutIntoDrive(i, 1);
  job.report.each_model.resize(2);
  job.report.images[19].model = 1;
  job.report.images[3].loose = true;
  job.report.images[16].registered = false;
  EXPECT_THAT(job.Paths(),
              ElementsAre(ElementsAre(0, 1, 2, 4, 5, 6, 7),
                          ElementsAre(8, 9, 10, 11, 12, 13),
                          ElementsAre(14, 15, 17, 18)));
  EXPECT_DOUBLE_EQ(job.model().path_length, 21.0 + 15.0 + 12.0);
  EXPECT_DOUBLE_EQ(job.model().step_median, 3.0);
  EXPECT_EQ(job.report.paths[2].drive, 1U);
  EXPECT_EQ(job.report.each_model[1].step_median, 0.0);
}

TEST(TracePaths, AreNoneOfNamesInNoOrderWhoseStepsAreThoseToTheNearest) {
  for (const uint32_t num_images : {24U, 100U, 700U}) {
    for (uint64_t seed = 0; seed < 5; ++seed) {
      Job job(Shuffled(Street(num_images, 9.0), seed));
      EXPECT_THAT(job.Paths(), IsEmpty()) << num_images;
      EXPECT_FALSE(job.model().is_in_order);
      EXPECT_DOUBLE_EQ(job.model().step_median, 9.0);
      EXPECT_EQ(job.model().path_length, 0.0);
    }
  }
}

/// Of places all over a quarter every sixth is five rows off, so that a third of the steps lead
/// there and back.
TEST(TracePaths, AreNoneWhereNamesTellTheOrderOfSomeAlone) {
  constexpr size_t kSide = 20;
  std::vector<Eigen::Vector3d> in_rows;
  for (size_t i = 0; i < kSide * kSide; ++i) {
    const size_t row = i / kSide;
    const size_t column = row % 2 == 0 ? i % kSide : kSide - 1 - i % kSide;
    in_rows.emplace_back(9.0 * static_cast<double>(column), 9.0 * static_cast<double>(row), 0.0);
  }
  std::vector<Eigen::Vector3d> places = in_rows;
  for (size_t i = 0; i + 102 < places.size(); i += 6) places[i] = in_rows[i + 102];
  Job ordered(in_rows);
  ordered.Paths();
  EXPECT_TRUE(ordered.model().is_in_order);
  Job job(places);
  EXPECT_THAT(job.Paths(), IsEmpty());
  EXPECT_FALSE(job.model().is_in_order);
}

TEST(TracePaths, KeepTheOrderOfTimesHoweverItGoes) {
  Job job(Shuffled(Street(40), 1));
  for (uint32_t i = 0; i < 40; ++i) job.manifest.images[i].capture_time_s = i;
  job.Paths();
  EXPECT_TRUE(job.model().is_in_order);
  EXPECT_GT(job.model().path_length, 0.0);
}

TEST(TracePaths, KnowTheOrderOfAStreetDrivenSeveralTimesAndOfACameraThatStands) {
  std::vector<Eigen::Vector3d> passes;
  Random random(3);
  for (int pass = 0; pass < 6; ++pass) {
    for (int i = 0; i < 30; ++i) {
      const double along = 5.0 * (pass % 2 == 0 ? i : 29 - i);
      passes.emplace_back(along + random.Normal(), random.Normal(), 0.0);
    }
  }
  Job driven(passes);
  driven.Paths();
  EXPECT_TRUE(driven.model().is_in_order);

  std::vector<Eigen::Vector3d> stops;
  for (int i = 0; i < 80; ++i) {
    const double along = 4.0 * (i < 20 ? i : i < 60 ? 20 : i - 40);
    stops.emplace_back(along, 0.02 * random.Normal(), 0.0);
  }
  Job standing(stops);
  EXPECT_EQ(standing.Paths().size(), 1U);
  EXPECT_TRUE(standing.model().is_in_order);
}

TEST(TracePaths, TellOneDriveFromAnotherThatIsInNoOrder) {
  std::vector<Eigen::Vector3d> places = Street(20);
  std::ranges::copy(Shuffled(Street(30, 7.0), 2), std::back_inserter(places));
  Job job(places);
  for (uint32_t i = 20; i < 50; ++i) job.PutIntoDrive(i, 1);
  ASSERT_EQ(job.Paths().size(), 1U);
  EXPECT_EQ(job.report.paths[0].drive, 0U);
  EXPECT_FALSE(job.model().is_in_order);
  EXPECT_DOUBLE_EQ(job.model().step_median, 7.0) << "of 19 and 30 steps";
}

TEST(TracePaths, TakeWhatIsDegenerate) {
  Job empty({});
  EXPECT_THAT(empty.Paths(), IsEmpty());
  Job one(Street(1));
  EXPECT_THAT(one.Paths(), IsEmpty());
  EXPECT_EQ(one.model().step_median, 0.0);
  Job heap(std::vector<Eigen::Vector3d>(9, Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(heap.Paths().size(), 1U);
  EXPECT_EQ(heap.model().path_length, 0.0);
}

}  // namespace
}  // namespace orbweave
