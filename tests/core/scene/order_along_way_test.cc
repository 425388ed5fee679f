// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/order_along_way.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Places = std::vector<Eigen::Vector3d>;

/// A street that bends, uneven steps of 4 m.
Places Street(size_t size, Random& random) {
  Places places = {Eigen::Vector3d::Zero()};
  while (places.size() < size) {
    const double heading = 1.2 * std::sin(0.05 * static_cast<double>(places.size()));
    const double step = 4.0 + random.Uniform(-1.5, 1.5);
    places.push_back(places.back() +
                     step * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.02));
  }
  return places;
}

/// places[i] is that of the street's image shuffle[i].
std::vector<uint32_t> Shuffle(size_t size, Random& random) {
  std::vector<uint32_t> shuffle(size);
  std::iota(shuffle.begin(), shuffle.end(), 0U);
  for (size_t i = size; i > 1; --i)
    std::swap(shuffle[i - 1], shuffle[random.Index(static_cast<uint32_t>(i))]);
  return shuffle;
}

Places Shuffled(const Places& places, const std::vector<uint32_t>& shuffle) {
  Places shuffled;
  for (const uint32_t i : shuffle) shuffled.push_back(places[i]);
  return shuffled;
}

TEST(VoteOnOrder, IsForAStreetAndAgainstOneWhoseNamesAreHashes) {
  Random random(1);
  for (const size_t size : {20U, 100U, 1500U}) {
    const Places street = Street(size, random);
    EXPECT_TRUE(VoteOnOrder(street).AreInOrder());
    EXPECT_FALSE(VoteOnOrder(Shuffled(street, Shuffle(size, random))).AreInOrder());
  }
}

TEST(VoteOnOrder, IsForACameraThatStandsAndDrivesBack) {
  Random random(2);
  Places places = Street(60, random);
  const auto tremble = [&] {
    return 0.01 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
  };
  for (int i = 0; i < 50; ++i) places.emplace_back(places[59] + tremble());
  for (size_t i = 0; i < 50; ++i) places.emplace_back(places[58 - i] + 200.0 * tremble());
  EXPECT_TRUE(VoteOnOrder(places).AreInOrder());
}

TEST(VoteOnOrder, TakesWhatIsDegenerate) {
  EXPECT_TRUE(VoteOnOrder({}).AreInOrder());
  EXPECT_TRUE(VoteOnOrder(Places(1)).AreInOrder());
  EXPECT_TRUE(VoteOnOrder(Places(50, Eigen::Vector3d::Ones())).AreInOrder());
}

TEST(OrderAlongWay, FindsTheStreetAgain) {
  Random random(3);
  for (const size_t size : {2U, 3U, 50U, 3000U}) {
    const std::vector<uint32_t> shuffle = Shuffle(size, random);
    const std::vector<uint32_t> order = OrderAlongWay(Shuffled(Street(size, random), shuffle));
    ASSERT_EQ(order.size(), size);
    std::vector<uint32_t> found;
    for (const uint32_t i : order) found.push_back(shuffle[i]);
    if (found.front() > found.back()) std::ranges::reverse(found);
    EXPECT_TRUE(std::ranges::is_sorted(found)) << size;
    EXPECT_LT(order.front(), order.back());
  }
}

TEST(OrderAlongWay, HasEveryPlaceOnceAndShortStepsWhereStreetsCross) {
  Random random(4);
  Places places;
  for (int i = -30; i <= 30; ++i) {
    places.emplace_back(4.0 * i, 0.1 * random.Normal(), 0.0);
    if (i != 0) places.emplace_back(0.1 * random.Normal(), 4.0 * i, 0.0);
  }
  const std::vector<uint32_t> shuffle = Shuffle(places.size(), random);
  const Places shuffled = Shuffled(places, shuffle);
  std::vector<uint32_t> order = OrderAlongWay(shuffled);
  size_t long_steps = 0;
  for (size_t i = 0; i + 1 < order.size(); ++i)
    long_steps += (shuffled[order[i + 1]] - shuffled[order[i]]).norm() > 10.0 ? 1 : 0;
  EXPECT_LE(long_steps, 3U);
  std::ranges::sort(order);
  for (uint32_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
}

TEST(OrderAlongWay, TakesWhatIsDegenerate) {
  EXPECT_THAT(OrderAlongWay({}), IsEmpty());
  EXPECT_THAT(OrderAlongWay(Places(1)), ElementsAre(0));
  EXPECT_EQ(OrderAlongWay(Places(40, Eigen::Vector3d::Ones())).size(), 40U);
}

}  // namespace
}  // namespace orbweave
