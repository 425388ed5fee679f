// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/deform_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/merging/carry_point.h"
#include "core/merging/georeference/georeference_reconstruction.h"
#include "core/synthetic/make_street.h"
#include "core/synthetic/street.h"

namespace orbweave {
namespace {

constexpr int kClusters = 60;
constexpr int kImages = 40;  // per cluster
constexpr double kStep_m = 2.0;

Rigid3 Upright(const Eigen::Vector3d& centre, double heading_rad) {
  Eigen::Matrix3d R;                                        // rows: right, down, forward
  R << std::sin(heading_rad), -std::cos(heading_rad), 0.0,  //
      0.0, 0.0, -1.0,                                       //
      std::cos(heading_rad), std::sin(heading_rad), 0.0;
  return Rigid3::FromCentre(Eigen::Quaterniond(R), centre);
}

// A winding street, what its reconstruction has drifted to, and its positions.
struct Street {
  std::vector<Rigid3> truth{};
  Reconstruction scene{};
  std::map<ImageId, uint32_t> clusters{};
  std::vector<WorldSeam> seams{};
  ImageManifest manifest{};

  [[nodiscard]] ClusteredWorld world() const { return {scene, clusters, seams}; }
};

struct Drift {
  double bend_rad = 0.0;  // from cluster to cluster
  double stretch = 0.0;   // over the whole street
};

Street MakeStreet(const Drift& drift, double gnss_sigma_m) {
  Street street;
  Random random(11);
  Eigen::Vector3d true_centre(500.0, -300.0, 10.0);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const int num_images = kClusters * kImages;
  for (int i = 0; i < num_images; ++i) {
    const ImageId id(static_cast<uint32_t>(i));
    const double share = static_cast<double>(i) / num_images;
    const double heading = 0.8 * std::sin(12.0 * share);
    const double bend = drift.bend_rad * static_cast<double>(i) / kImages;
    street.truth.push_back(Upright(true_centre, heading));
    street.scene.images[id].cam_from_world = Upright(centre, heading + bend);
    street.clusters[id] = static_cast<uint32_t>(i / kImages);
    ImageRecord record;
    record.id = id;
    record.prior.position_in_enu =
        true_centre +
        gnss_sigma_m * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
    record.prior.horizontal_sigma_m = std::max(gnss_sigma_m, 0.1);
    record.prior.vertical_sigma_m = std::max(gnss_sigma_m, 0.1);
    street.manifest.images.push_back(record);
    if (i % kImages == 0 && i > 0) {
      const auto cluster = static_cast<uint32_t>(i / kImages);
      street.seams.push_back({cluster - 1, cluster, centre});
    }
    const double step = kStep_m * (1.0 + drift.stretch * share);
    true_centre += kStep_m * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0);
    centre += step * Eigen::Vector3d(std::cos(heading + bend), std::sin(heading + bend), 0.0);
  }
  return street;
}

std::map<uint32_t, Sim3> Place(const Street& street) {
  const StageContext context{.seed = 5};
  const auto rigid =
      GeoreferenceReconstruction(street.scene, street.manifest, GnssUse::kAuto, context);
  EXPECT_TRUE(rigid.ok()) << rigid.status();
  const auto places =
      PlaceClusters(street.world(), *rigid, street.manifest, GnssUse::kAuto, {}, context);
  EXPECT_TRUE(places.ok()) << places.status();
  return places.value_or(std::map<uint32_t, Sim3>{});
}

Reconstruction Bent(const Street& street) {
  return DeformWorld(street.scene, street.clusters, street.seams, Place(street));
}

double LargestError_m(const Street& street, const Reconstruction& bent) {
  double largest = 0.0;
  for (const auto& [id, image] : bent.images) {
    const Eigen::Vector3d gap = image.cam_from_world.Centre() - street.truth[id.value].Centre();
    largest = std::max(largest, gap.norm());
  }
  return largest;
}

// Of the step from each image to the next, in the first one's camera.
double LargestStepError_m(const Street& street, const Reconstruction& bent) {
  double largest = 0.0;
  for (size_t i = 0; i + 1 < street.truth.size(); ++i) {
    const auto step = [](const Rigid3& from, const Rigid3& to) { return from * to.Centre(); };
    const Rigid3& from = bent.images.at(ImageId(static_cast<uint32_t>(i))).cam_from_world;
    const Rigid3& to = bent.images.at(ImageId(static_cast<uint32_t>(i + 1))).cam_from_world;
    const Eigen::Vector3d gap = step(from, to) - step(street.truth[i], street.truth[i + 1]);
    largest = std::max(largest, gap.norm());
  }
  return largest;
}

constexpr Drift kDrift{.bend_rad = 0.01, .stretch = 0.02};

TEST(PlaceClusters, LeavesARigidStreetAlone) { EXPECT_TRUE(Place(MakeStreet({}, 1.5)).empty()); }

TEST(PlaceClusters, LeavesAStreetWithoutGnssAlone) {
  Street street = MakeStreet(kDrift, 1.5);
  for (ImageRecord& image : street.manifest.images) image.prior.position_in_enu.reset();
  EXPECT_TRUE(Place(street).empty());
}

TEST(PlaceClusters, DoesNotReachClustersWithoutASeam) {
  Street street = MakeStreet(kDrift, 1.5);
  street.seams.clear();
  for (ImageRecord& image : street.manifest.images) {
    if (image.id.value < kImages) image.prior.position_in_enu.reset();
  }
  EXPECT_TRUE(Place(street).empty());
}

// A drifted street at whose end two clusters have loose images alone.
Street StreetWithALooseEnd() {
  Street street = MakeStreet(kDrift, 1.5);
  for (auto& [id, image] : street.scene.images) image.loose = street.clusters.at(id) >= 58;
  return street;
}

TEST(PlaceClusters, PlacesLooseClustersByTheirNeighbour) {
  const std::map<uint32_t, Sim3> places = Place(StreetWithALooseEnd());
  ASSERT_EQ(places.size(), static_cast<size_t>(kClusters));
  EXPECT_EQ(places.at(58).translation, places.at(57).translation);
  EXPECT_EQ(places.at(59).translation, places.at(57).translation);
  EXPECT_EQ(places.at(59).scale, places.at(57).scale);
  EXPECT_NE(places.at(59).translation, places.at(0).translation);
}

TEST(PlaceClusters, DoesNotReachLooseClustersWithoutASeam) {
  Street street = StreetWithALooseEnd();
  street.seams.pop_back();
  EXPECT_TRUE(Place(street).empty());
}

TEST(DeformWorld, TakesADriftedStreetToItsGnss) {
  const Street street = MakeStreet(kDrift, 1.5);
  const auto rigid = GeoreferenceReconstruction(
      street.scene, street.manifest, GnssUse::kAuto, StageContext{.seed = 5});
  ASSERT_TRUE(rigid.ok());
  if (rigid->enu_from_world) {
    EXPECT_GT(LargestError_m(street, Transformed(*rigid->enu_from_world, street.scene)), 100.0);
  }
  const Reconstruction bent = Bent(street);
  EXPECT_LT(LargestError_m(street, bent), 3.0);
  EXPECT_LT(LargestStepError_m(street, bent), 0.1);
}

TEST(DeformWorld, LaysNoHillFlatWhereNobodyKnowsHeights) {
  Street street = MakeStreet(kDrift, 1.5);
  const auto raise = [](Rigid3& pose, double height_m) {
    pose = Rigid3::FromCentre(pose.rotation, pose.Centre() + height_m * Eigen::Vector3d::UnitZ());
  };
  for (size_t i = 0; i < street.truth.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(street.truth.size());
    const double height_m = 60.0 * std::sin(12.0 * share);
    raise(street.truth[i], height_m);
    raise(street.scene.images.at(ImageId(static_cast<uint32_t>(i))).cam_from_world, height_m);
    street.manifest.images[i].prior.position_in_enu->z() = 0.0;
    street.manifest.images[i].prior.vertical_sigma_m = kUnknownHeightSigma_m;
  }
  const Reconstruction bent = Bent(street);
  ASSERT_EQ(bent.images.size(), street.truth.size());
  const auto height_m = [](const Rigid3& pose) { return pose.Centre().z(); };
  const double begin_m = height_m(bent.images.begin()->second.cam_from_world);
  for (const auto& [id, image] : bent.images) {
    const double true_height_m = height_m(street.truth[id.value]) - height_m(street.truth[0]);
    EXPECT_NEAR(height_m(image.cam_from_world) - begin_m, true_height_m, 6.0) << id.value;
  }
}

TEST(DeformWorld, BridgesATunnel) {
  Street street = MakeStreet(kDrift, 1.5);
  for (ImageRecord& image : street.manifest.images) {
    const uint32_t cluster = image.id.value / kImages;
    if (cluster >= 20 && cluster < 24) image.prior.position_in_enu.reset();
  }
  const Reconstruction bent = Bent(street);
  EXPECT_LT(LargestError_m(street, bent), 6.0);
  EXPECT_LT(LargestStepError_m(street, bent), 0.1);
}

TEST(DeformWorld, DoesNotFollowPositionsThatJump) {
  Street street = MakeStreet(kDrift, 1.5);
  for (ImageRecord& image : street.manifest.images) {
    const uint32_t cluster = image.id.value / kImages;
    if (cluster >= 30 && cluster < 33) *image.prior.position_in_enu += Eigen::Vector3d(0, 60, 0);
  }
  const Reconstruction bent = Bent(street);
  EXPECT_LT(LargestError_m(street, bent), 6.0);
  EXPECT_LT(LargestStepError_m(street, bent), 0.1);
}

TEST(DeformWorld, AppliesOneSimilarityForAllExactly) {
  Street street = MakeStreet(kDrift, 1.5);
  Track track;
  track.point_in_world = {30.0, 8.0, 3.0};
  for (uint32_t i = 10; i < 14; ++i) track.observations.push_back({.ref = {ImageId(i), 0}});
  street.scene.tracks.push_back(track);
  const Sim3 place{1.7, RotationFromVector({0.3, -0.2, 1.0}), {5.0, 6.0, 7.0}};
  std::map<uint32_t, Sim3> places;
  for (uint32_t c = 0; c < kClusters; ++c) places[c] = place;
  const Reconstruction bent = DeformWorld(street.scene, street.clusters, street.seams, places);
  const Reconstruction expected = Transformed(place, street.scene);
  for (const auto& [id, image] : bent.images) {
    const Rigid3& other = expected.images.at(id).cam_from_world;
    EXPECT_LT((image.cam_from_world.Centre() - other.Centre()).norm(), 1e-8);
    EXPECT_LT(RotationAngle(image.cam_from_world.rotation * other.rotation.conjugate()), 1e-10);
  }
  EXPECT_LT((bent.tracks[0].point_in_world - expected.tracks[0].point_in_world).norm(), 1e-8);
}

TEST(DeformWorld, CarriesPointsWithTheImagesThatSeeThem) {
  Street street = MakeStreet(kDrift, 1.5);
  for (uint32_t first = 0; first + 4 < kClusters * kImages; first += 5) {
    Track& track = street.scene.tracks.emplace_back();
    const Rigid3& pose = street.scene.images.at(ImageId(first)).cam_from_world;
    track.point_in_world = pose.Inverse() * Eigen::Vector3d(7.0, -2.0, 3.0);
    for (uint32_t i = first; i < first + 4; ++i)
      track.observations.push_back({.ref = {ImageId(i), first}});
  }
  const Reconstruction bent = Bent(street);
  for (size_t t = 0; t < bent.tracks.size(); ++t) {
    for (const Observation& seen : bent.tracks[t].observations) {
      const Eigen::Vector3d before = street.scene.images.at(seen.ref.image).cam_from_world *
                                     street.scene.tracks[t].point_in_world;
      const Eigen::Vector3d after =
          bent.images.at(seen.ref.image).cam_from_world * bent.tracks[t].point_in_world;
      EXPECT_LT(AngleBetween(before, after), 0.01) << t;  // 9 px of 5400
    }
  }
}

TEST(CarryPoint, NeedsAnObserverInBoth) {
  Track track;
  track.observations.push_back({.ref = {ImageId(3), 0}});
  EXPECT_FALSE(CarryPoint(track, {}, {}, 1.0).has_value());
}

}  // namespace
}  // namespace orbweave
