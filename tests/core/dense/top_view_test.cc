// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/top_view.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

Rgb RandomColor(Random& random) {
  const auto byte = [&] { return static_cast<uint8_t>(random.Uniform(0.0, 255.0)); };
  return {byte(), byte(), byte()};
}

std::vector<SurfacePoint> RandomPoints(int count, double extent) {
  Random random(5);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < count; ++i) {
    const Vector3d position = testing::RandomPoint(random, 0.0, extent);
    points.push_back({.position_in_world = position, .color = RandomColor(random)});
  }
  return points;
}

Rgb ColorAt(const TopPicture& picture, int column, int row) {
  const size_t k = 4 * (static_cast<size_t>(row) * static_cast<size_t>(picture.width_px) +
                        static_cast<size_t>(column));
  return {picture.rgba[k], picture.rgba[k + 1], picture.rgba[k + 2]};
}

/// Where the picture itself says that a point lies.
std::pair<int, int> PixelOf(const TopPicture& picture, const Vector3d& point) {
  const double x = picture.right.dot(point) - picture.corner.x();
  const double y = picture.corner.y() - picture.ahead.dot(point);
  return {static_cast<int>(std::floor(x / picture.pixel)),
          static_cast<int>(std::floor(y / picture.pixel))};
}

TEST(TopView, ShowsTheHighestPointOfEachPixelHoweverOftenItDoubles) {
  const std::vector<SurfacePoint> points = RandomPoints(4000, 30.0);
  TopView view(Vector3d::UnitZ(), 0.03, 64);
  for (size_t i = 0; i < points.size(); i += 100) view.Add(std::span(points).subspan(i, 100));
  const TopPicture picture = view.Picture();
  EXPECT_LE(picture.width_px, 64);
  EXPECT_GT(picture.width_px, 16);
  std::map<std::pair<int, int>, const SurfacePoint*> highest;
  for (const SurfacePoint& point : points) {
    const SurfacePoint*& shown = highest[PixelOf(picture, point.position_in_world)];
    if (shown == nullptr || point.position_in_world.z() > shown->position_in_world.z())
      shown = &point;
  }
  size_t seen = 0;
  for (size_t k = 3; k < picture.rgba.size(); k += 4) seen += picture.rgba[k] == 255 ? 1 : 0;
  EXPECT_EQ(seen, highest.size());
  for (const auto& [pixel, point] : highest)
    EXPECT_EQ(ColorAt(picture, pixel.first, pixel.second), point->color);
}

TEST(TopView, LooksAlongUpWithEastToTheRightAndNorthToTheTop) {
  TopView view(Vector3d::UnitZ(), 1.0, 64);
  const Rgb red{255, 0, 0};
  const Rgb green{0, 255, 0};
  view.Add(std::vector<SurfacePoint>{{.position_in_world = {9.5, 0.5, 0.0}, .color = red},
                                     {.position_in_world = {0.5, 4.5, 0.0}, .color = green}});
  const TopPicture picture = view.Picture();
  ASSERT_EQ(picture.width_px, 10);
  ASSERT_EQ(picture.height_px, 5);
  EXPECT_EQ(ColorAt(picture, 9, 4), red);
  EXPECT_EQ(ColorAt(picture, 0, 0), green);
  EXPECT_EQ(picture.corner, Eigen::Vector2d(0.0, 5.0));
}

TEST(TopView, AnyDirectionMayBeUp) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Quaterniond turn = testing::RandomRotation(random);
    TopView view(turn * Vector3d::UnitZ(), 0.5, 64);
    const Rgb top{1, 2, 3};
    const Vector3d foot(4.0, -3.0, 0.0);
    view.Add(std::vector<SurfacePoint>{
        {.position_in_world = turn * foot, .color = {9, 9, 9}},
        {.position_in_world = turn * (foot + Vector3d(0.0, 0.0, 5.0)), .color = top}});
    const TopPicture picture = view.Picture();
    // Rounding may part the two over a border.
    const auto [column, row] = PixelOf(picture, turn * (foot + Vector3d(0.0, 0.0, 5.0)));
    EXPECT_EQ(ColorAt(picture, column, row), top);
    EXPECT_LT(std::abs(picture.right.dot(picture.ahead)), 1e-12);
    EXPECT_GT(picture.right.cross(picture.ahead).dot(turn * Vector3d::UnitZ()), 0.999999);
  }
}

TEST(TopView, OfNothingIsEmpty) {
  TopView view(Vector3d::UnitZ(), 1.0, 64);
  view.Add({});
  EXPECT_EQ(view.Picture().width_px, 0);
}

}  // namespace
}  // namespace orbweave
