// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using Place = std::function<Eigen::Vector3d(double)>;
using Depth = std::function<double(uint32_t)>;

/// A drive: panoramas turned anyhow, edges with noise of 0.01 rad in direction and 0.002 in turn.
class Drive {
 public:
  Drive(
      uint32_t count, const Place& place, Depth depth_m = [](uint32_t) { return 12.0; })
      : depth_m_(std::move(depth_m)) {
    for (uint32_t i = 0; i < count; ++i) {
      const Eigen::Vector3d turn(random_.Normal(), random_.Normal(), random_.Normal());
      cams_.push_back(Rigid3::FromCentre(RotationFromVector(turn), place(i)));
      manifest.images.push_back({.id = ImageId(i)});
    }
    for (uint32_t a = 0; a < count; ++a) {
      for (uint32_t b = a + 1; b <= a + 6 && b < count; ++b) edges.push_back(TrueEdge(a, b));
    }
  }

  /// What panoramas a and b see of each other, rightly.
  ViewEdge TrueEdge(uint32_t a, uint32_t b) { return Between(a, b, cams_[b] * cams_[a].Inverse()); }
  /// b taken for a panorama that stands `shift` off a in the world and looks as b does.
  ViewEdge LookAlike(uint32_t a, uint32_t b, const Eigen::Vector3d& shift) {
    const Rigid3 taken = Rigid3::FromCentre(cams_[b].rotation, cams_[a].Centre() + shift);
    return Between(a, b, taken * cams_[a].Inverse());
  }
  ImageManifest manifest{};
  std::vector<ViewEdge> edges{};

 private:
  Eigen::Vector3d Noise(double size) {
    return size * Eigen::Vector3d(random_.Normal(), random_.Normal(), random_.Normal());
  }
  ViewEdge Between(uint32_t a, uint32_t b, const Rigid3& b_from_a) {
    ViewEdge edge = Edge(a, b);
    const double baseline_m = b_from_a.translation.norm();
    edge.b_from_a.rotation = RotationFromVector(Noise(0.002)) * b_from_a.rotation;
    edge.b_from_a.translation = (b_from_a.translation.normalized() + Noise(0.01)).normalized();
    edge.median_angle_rad = 2.0 * std::atan(0.5 * baseline_m / depth_m_(a));
    return edge;
  }

  Random random_{7};
  Depth depth_m_;
  std::vector<Rigid3> cams_;
};

Eigen::Vector3d Straight(double i) { return {3.0 * i, 0.0, 0.0}; }

/// A rectangle of 60 x 20 steps of 3 m, then the same again.
Eigen::Vector3d Block(double i) {
  const double at = std::fmod(i, 160.0);
  if (at < 60.0) return {3.0 * at, 0.0, 0.0};
  if (at < 80.0) return {180.0, 3.0 * (at - 60.0), 0.0};
  if (at < 140.0) return {3.0 * (140.0 - at), 60.0, 0.0};
  return {0.0, 3.0 * (160.0 - at), 0.0};
}

TEST(DropEdgesAgainstChain, DropsFacadesThatRepeatAlongAStreet) {
  Drive drive(60, Straight);
  const size_t right = drive.edges.size();
  for (uint32_t a = 0; a + 21 < 60; ++a) {
    drive.edges.push_back(drive.LookAlike(a, a + 19, {-3.0, 0.0, 0.0}));
    drive.edges.push_back(drive.LookAlike(a, a + 20, {0.1, 0.2, 0.0}));
    drive.edges.push_back(drive.LookAlike(a, a + 21, {3.0, 0.0, 0.0}));
  }
  const SiftedEdges result = DropEdgesAgainstChain(drive.edges, drive.manifest);
  EXPECT_EQ(result.kept.size(), right);
  ASSERT_EQ(result.dropped.size(), 3U * 39U);
  EXPECT_EQ(result.dropped[1].reason,
            "the 20 steps of the drive between its images do not end where it says");
}

TEST(DropEdgesAgainstChain, DropsLookAlikesAmongNeighboursThatPointBackwards) {
  Drive drive(60, Straight);
  const size_t right = drive.edges.size();
  std::erase_if(drive.edges, [](const ViewEdge& edge) {
    return edge.pair.b.value - edge.pair.a.value == 5 && edge.pair.a.value % 4 == 0;
  });
  const size_t left = drive.edges.size();
  for (uint32_t a = 0; a + 5 < 60; a += 4)
    drive.edges.push_back(drive.LookAlike(a, a + 5, {-9.0, 0.0, 0.0}));
  ASSERT_EQ(drive.edges.size(), right);
  EXPECT_EQ(DropEdgesAgainstChain(drive.edges, drive.manifest).kept.size(), left);
}

TEST(DropEdgesAgainstChain, DropsEdgesThatTurnOtherwiseThanTheDrive) {
  Drive drive(200, Block);
  const size_t right = drive.edges.size();
  drive.edges.push_back(drive.TrueEdge(10, 170));
  ViewEdge turned = drive.TrueEdge(12, 172);
  turned.b_from_a.rotation =
      RotationFromVector({0.0, std::numbers::pi / 2.0, 0.0}) * turned.b_from_a.rotation;
  drive.edges.push_back(turned);
  const SiftedEdges result = DropEdgesAgainstChain(drive.edges, drive.manifest);
  EXPECT_EQ(result.kept.size(), right + 1);
  ASSERT_EQ(result.dropped.size(), 1U);
  EXPECT_TRUE(result.dropped[0].reason.starts_with("turns by ")) << result.dropped[0].reason;
}

TEST(DropEdgesAgainstChain, KeepsRevisitsWhereverTheyCome) {
  Drive twice_round(320, Block);
  for (uint32_t a = 0; a < 160; ++a) twice_round.edges.push_back(twice_round.TrueEdge(a, a + 160));
  for (uint32_t a = 0; a < 5; ++a) twice_round.edges.push_back(twice_round.TrueEdge(a, 155 + a));
  EXPECT_TRUE(DropEdgesAgainstChain(twice_round.edges, twice_round.manifest).dropped.empty());

  Drive out_and_back(200, [](double i) {
    return i < 100.0 ? Eigen::Vector3d(3.0 * i, 0.0, 0.0)
                     : Eigen::Vector3d(3.0 * (199.0 - i), 4.0, 0.0);
  });
  for (uint32_t a = 0; a < 94; ++a) out_and_back.edges.push_back(out_and_back.TrueEdge(a, 199 - a));
  EXPECT_TRUE(DropEdgesAgainstChain(out_and_back.edges, out_and_back.manifest).dropped.empty());
}

TEST(DropEdgesAgainstChain, KeepsARevisitWhereOneSideOfTheBlockIsFourTimesAsWide) {
  Drive wide(320, Block, [](uint32_t a) { return a % 160 < 60 ? 8.0 : 32.0; });
  for (uint32_t a = 0; a < 160; ++a) wide.edges.push_back(wide.TrueEdge(a, a + 160));
  EXPECT_TRUE(DropEdgesAgainstChain(wide.edges, wide.manifest).dropped.empty());
}

TEST(DropEdgesAgainstChain, KeepsWhatSeesFarAmongNeighbours) {
  Drive drive(60, Straight);
  for (ViewEdge& edge : drive.edges) {
    const bool sees_a_tower = edge.pair.b.value - edge.pair.a.value == 6;
    if (sees_a_tower) edge.median_angle_rad = 0.05;
  }
  EXPECT_TRUE(DropEdgesAgainstChain(drive.edges, drive.manifest).dropped.empty());
}

TEST(DropEdgesAgainstChain, SaysNothingWhereTheSequenceBreaksOrGnssAgrees) {
  Drive broken(60, Straight);
  std::erase_if(broken.edges, [](const ViewEdge& edge) {
    return edge.pair.a.value < 30 && edge.pair.b.value >= 30;
  });
  broken.edges.push_back(broken.LookAlike(20, 40, Eigen::Vector3d(1.0, 0.0, 0.0)));
  EXPECT_TRUE(DropEdgesAgainstChain(broken.edges, broken.manifest).dropped.empty());

  Drive two(60, Straight);
  two.edges.push_back(two.LookAlike(20, 40, Eigen::Vector3d(1.0, 0.0, 0.0)));
  EXPECT_EQ(DropEdgesAgainstChain(two.edges, two.manifest).dropped.size(), 1U);
  ImageManifest near = two.manifest;
  for (ImageRecord& image : near.images) {
    image.prior.position_in_enu = Eigen::Vector3d::Zero();
    image.prior.horizontal_sigma_m = 2.0;
  }
  EXPECT_TRUE(DropEdgesAgainstChain(two.edges, near).dropped.empty());
  for (uint32_t i = 30; i < 60; ++i) two.manifest.images[i].drive = 1;
  EXPECT_TRUE(DropEdgesAgainstChain(two.edges, two.manifest).dropped.empty());
  EXPECT_TRUE(DropEdgesAgainstChain({}, {}).dropped.empty());
}

}  // namespace
}  // namespace orbweave
