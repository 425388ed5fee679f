// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_hardships.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>
#include <string>

#include "core/synthetic/camera_rays.h"
#include "core/synthetic/lens_rig.h"
#include "core/synthetic/make_street.h"
#include "core/synthetic/realistic_street.h"
#include "core/synthetic/render_street_panorama.h"

namespace orbweave {
namespace {

constexpr int kWidth = 192;

StreetOptions Tiny(const StreetHardships& hardships) {
  return {.panoramas = 24, .width_px = kWidth, .spacing_m = 6.0, .hardships = hardships};
}

/// What the middle of each pixel sees on the first day without traffic; row by row.
std::vector<SurfaceHit> HitsOf(const Street& street, size_t i) {
  const EquirectangularCamera camera{kWidth, kWidth / 2};
  const Rigid3 enu_from_street{Eigen::Quaterniond::Identity(), street.street_in_enu};
  const Rigid3 cam_from_street = street.cams_from_enu[i] * enu_from_street;
  const CameraRays rays(camera, cam_from_street, {}, {});
  const Traffic none({});
  std::vector<SurfaceHit> hits;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const Eigen::Vector3d bearing = camera.BearingFromPixel({column + 0.5, row + 0.5});
      hits.push_back(Trace(street.world, none, rays.Through(bearing, row + 0.5)));
    }
  }
  return hits;
}

bool Differ(const Rgb& a, const Rgb& b, int tolerance) {
  return std::abs(a.r - b.r) > tolerance || std::abs(a.g - b.g) > tolerance ||
         std::abs(a.b - b.b) > tolerance;
}

/// Share of pixels that differ by more than 3 levels, of those that `which` picks.
double ChangedShare(const RenderedPanorama& a,
                    const RenderedPanorama& b,
                    const std::function<bool(size_t)>& which) {
  double picked = 0.0;
  double changed = 0.0;
  for (size_t k = 0; k < a.pixels.size(); ++k) {
    if (!which(k)) continue;
    picked += 1.0;
    changed += Differ(a.pixels[k], b.pixels[k], 3) ? 1.0 : 0.0;
  }
  return picked == 0.0 ? 0.0 : changed / picked;
}

bool Everywhere(size_t) { return true; }

struct NamedHardship {
  const char* name;
  StreetHardships hardships;
};

TEST(StreetHardships, EachChangesPicturesButNoTruth) {
  const NamedHardship cases[] = {{"plain", {.plain_share = 1.0}},
                                 {"reflection", {.reflection = 1.0}},
                                 {"equal windows", {.equal_windows = true}},
                                 {"wind", {.wind_m = 0.2}},
                                 {"second day", {.second_day_share = 1.0}},
                                 {"pedestrians", {.pedestrians = 30}},
                                 {"vehicles", {.vehicles = 8}},
                                 {"bus", {.bus_ahead = true}},
                                 {"light", {.harsh_light = 0.5}},
                                 {"dim", {.daylight = 0.3}},
                                 {"white balance", {.white_balance_spread = 0.4}},
                                 {"vignetting", {.vignetting = 0.5}},
                                 {"noise", {.shade_noise_levels = 20.0}},
                                 {"blur", {.shade_blur_px = 2.0}},
                                 {"lenses", {.lens_offset_m = 0.2}},
                                 {"shutter", {.rolling_shutter_s = 0.1}},
                                 {"nadir", {.nadir = NadirKind::kBlack}}};
  const StreetOptions plain = Tiny({});
  const Street street = MakeStreet(plain);
  const RenderedPanorama before = RenderStreetPanorama(street, plain, 3);
  for (const NamedHardship& hardship : cases) {
    const StreetOptions options = Tiny(hardship.hardships);
    const Street hard = MakeStreet(options);
    const RenderedPanorama after = RenderStreetPanorama(hard, options, 3);
    EXPECT_GT(ChangedShare(before, after, Everywhere), 0.004) << hardship.name;
    for (size_t i = 0; i < street.names.size(); ++i) {
      EXPECT_EQ(hard.cams_from_enu[i].rotation.coeffs(), street.cams_from_enu[i].rotation.coeffs());
      EXPECT_LT((hard.cams_from_enu[i].Centre() - hard.street_in_enu -
                 street.cams_from_enu[i].Centre() + street.street_in_enu)
                    .norm(),
                1e-9)
          << hardship.name;
    }
  }
}

TEST(StreetHardships, MaskAndGeometryStayUnderWhatTheCameraDoes) {
  const StreetOptions plain = Tiny({});
  const StreetOptions hard = Tiny({.harsh_light = 0.5,
                                   .daylight = 0.5,
                                   .white_balance_spread = 0.3,
                                   .vignetting = 0.4,
                                   .shade_noise_levels = 10.0,
                                   .shade_blur_px = 1.0});
  const Street street = MakeStreet(plain);
  EXPECT_EQ(RenderStreetPanorama(street, plain, 5).ignored,
            RenderStreetPanorama(MakeStreet(hard), hard, 5).ignored);
}

TEST(StreetHardships, WindMovesTreesAndCloudsAndLetsHousesStand) {
  StreetOptions plain = Tiny({});
  StreetOptions windy = Tiny({.wind_m = 0.3});
  const Street street = MakeStreet(plain);
  double crowns = 0.0;
  double houses = 0.0;
  for (const size_t i : {size_t{4}, size_t{9}, size_t{16}}) {
    const std::vector<SurfaceHit> hits = HitsOf(street, i);
    const RenderedPanorama before = RenderStreetPanorama(street, plain, i);
    const RenderedPanorama after = RenderStreetPanorama(street, windy, i);
    const auto shows = [&](size_t k, SolidKind kind) {
      return hits[k].surface > SurfaceHit::kGround &&
             street.world.solids[hits[k].solid].kind == kind;
    };
    crowns += ChangedShare(before, after, [&](size_t k) { return shows(k, SolidKind::kCrown); });
    houses += ChangedShare(before, after, [&](size_t k) { return shows(k, SolidKind::kBuilding); });
  }
  EXPECT_GT(crowns / 3.0, 0.6);
  EXPECT_LT(houses / 3.0, 0.12);  // behind moved crowns and under their shadows
}

TEST(StreetHardships, VignettingDarkensWhatIsFarFromALensAxis) {
  const StreetOptions plain = Tiny({});
  const StreetOptions dark = Tiny({.vignetting = 0.4});
  const Street street = MakeStreet(plain);
  const RenderedPanorama before = RenderStreetPanorama(street, plain, 5);
  const RenderedPanorama after = RenderStreetPanorama(street, dark, 5);
  const size_t middle = kWidth / 4 * kWidth + kWidth / 2;  // the forward lens's axis
  EXPECT_FALSE(Differ(before.pixels[middle], after.pixels[middle], 2));
  const size_t corner = kWidth / 4 * kWidth + kWidth * 6 / 10;  // 36 degrees to the right
  const double gain = LensRig{.vignetting = 0.4}.Gain({std::sin(0.628), 0.0, std::cos(0.628)});
  EXPECT_LT(gain, 0.75);
  EXPECT_NEAR(after.pixels[corner].g, gain * before.pixels[corner].g, 5.0);
}

/// Colour that a camera at `from` sees of a place.
Colour SeenFrom(const StreetWorld& world, const Eigen::Vector3d& from, const SurfaceHit& place) {
  const Traffic none({});
  const LightRay ray{from, (place.point - from).normalized()};
  const SurfaceHit hit = Trace(world, none, ray);
  return Shade(world, none, ray, hit, 1e-5);
}

TEST(StreetHardships, PanesShowOtherThingsFromOtherPlacesOnlyIfTheyReflect) {
  double mirrored = 0.0;
  double matt = 0.0;
  for (const double reflection : {0.0, 1.0}) {
    const Street street =
        MakeStreet(Tiny({.plain_share = 1.0, .reflection = reflection, .equal_windows = true}));
    const Eigen::Vector3d centre = street.cams_from_enu[5].Centre() - street.street_in_enu;
    const Eigen::Vector3d next = centre + Eigen::Vector3d(0.4, 0.3, 0.2);
    for (const SurfaceHit& hit : HitsOf(street, 5)) {
      if (hit.surface <= SurfaceHit::kGround || hit.distance_m > 15.0) continue;
      if (street.world.solids[hit.solid].kind != SolidKind::kBuilding) continue;
      const double change =
          (SeenFrom(street.world, centre, hit) - SeenFrom(street.world, next, hit)).norm();
      (reflection > 0.0 ? mirrored : matt) += std::min(0.2, change);
    }
  }
  EXPECT_GT(mirrored, 3.0 * matt);
}

TEST(StreetHardships, RepeatedHousesHaveTheSameSizeSeedAndFixtures) {
  const StreetWorld world = MakeStreetWorld(400.0, 7, {.repeat_share = 1.0});
  std::vector<Solid> houses;
  for (const Solid& solid : world.solids)
    if (solid.kind == SolidKind::kBuilding) houses.push_back(solid);
  size_t same = 0;
  for (size_t k = 1; k < houses.size(); ++k) {
    if (houses[k].seed != houses[k - 1].seed) continue;
    EXPECT_EQ(houses[k].half, houses[k - 1].half);
    ++same;
  }
  EXPECT_GT(same, houses.size() / 2);
  std::set<uint32_t> fixtures;
  size_t count = 0;
  for (const Solid& solid : world.solids) {
    if (solid.kind != SolidKind::kFixture) continue;
    fixtures.insert(solid.seed);
    ++count;
  }
  EXPECT_LT(fixtures.size(), count / 2);
}

TEST(StreetHardships, TheShareOfPlainHousesIsTheOneAskedFor) {
  int plain = 0;
  int houses = 0;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    for (const Solid& solid : MakeStreetWorld(300.0, seed, {.plain_share = 0.6}).solids) {
      if (solid.kind != SolidKind::kBuilding) continue;
      ++houses;
      plain += solid.look.plain;
    }
  }
  EXPECT_NEAR(static_cast<double>(plain) / houses, 0.6, 0.06);
}

TEST(StreetHardships, ACameraThatStandsSeesOtherTrafficFromTheSamePlace) {
  const StreetOptions options = Tiny({.standing = true, .pedestrians = 25});
  const Street street = MakeStreet(options);
  for (const Rigid3& cam : street.cams_from_enu) {
    EXPECT_EQ(cam.translation, street.cams_from_enu[0].translation);
    EXPECT_EQ(cam.rotation.coeffs(), street.cams_from_enu[0].rotation.coeffs());
  }
  EXPECT_TRUE(street.measured_in_enu[0] != street.measured_in_enu[1]);
  const RenderedPanorama a = RenderStreetPanorama(street, options, 0);
  const RenderedPanorama b = RenderStreetPanorama(street, options, 1);
  size_t moving = 0;
  for (size_t k = 0; k < a.ignored.size(); ++k) moving += a.ignored[k] != b.ignored[k];
  EXPECT_GT(moving, 20U);
}

TEST(StreetHardships, ADriveStopsAndGoesOn) {
  const Street drive = MakeStreet(Tiny({}));
  const Street street = MakeStreet(Tiny({.stop_panoramas = 10}));
  ASSERT_EQ(street.cams_from_enu.size(), 24U);
  for (size_t i = 1; i < 24; ++i) {
    const bool stands = i > 7 && i < 17;
    const double step_m =
        (street.cams_from_enu[i].Centre() - street.cams_from_enu[i - 1].Centre()).norm();
    EXPECT_EQ(step_m == 0.0, stands) << i;
    EXPECT_GT(street.capture_times_s[i], street.capture_times_s[i - 1]) << i;
  }
  EXPECT_EQ(street.stations_m[7], drive.stations_m[7]);
  EXPECT_EQ(street.stations_m[17], drive.stations_m[8]);
}

TEST(StreetHardships, ASlowCameraDoesNotJumpAside) {
  StreetOptions options = Tiny({});
  options.spacing_m = 0.01;
  const Street street = MakeStreet(options);
  for (size_t i = 1; i < street.cams_from_enu.size(); ++i) {
    const double step_m =
        (street.cams_from_enu[i].Centre() - street.cams_from_enu[i - 1].Centre()).norm();
    EXPECT_GT(step_m, 0.005) << i;
    EXPECT_LT(step_m, 0.025) << i;
  }
}

TEST(StreetHardships, StepsSpreadAsAskedAndKeepTheirMean) {
  const Street street = MakeStreet(Tiny({.spacing_spread = 0.4}));
  double longest = 0.0;
  double shortest = 1e9;
  for (size_t i = 1; i < 24; ++i) {
    const double step_m = street.stations_m[i] - street.stations_m[i - 1];
    longest = std::max(longest, step_m);
    shortest = std::min(shortest, step_m);
  }
  EXPECT_GE(shortest, 6.0 * 0.6);
  EXPECT_LE(longest, 6.0 * 1.4);
  EXPECT_GT(longest - shortest, 6.0 * 0.3);
  EXPECT_NEAR((street.stations_m[23] - street.stations_m[0]) / 23.0, 6.0, 0.2);
}

TEST(RealisticStreet, HasEveryHardshipThatAPlainStreetCanHave) {
  const StreetOptions options = RealisticStreet({});
  EXPECT_TRUE(ValidateOptions("street", options).ok());
  EXPECT_TRUE(ValidateOptions("street", options.hardships).ok());
  // Scenes of their own, a matter of taste, and what half the repeated houses bring already.
  const std::set<std::string> others = {
      "room", "standing", "stop_panoramas", "bus_ahead", "daylight", "speed_mps", "equal_windows"};
  const StreetHardships none;
  internal::ForEachField(
      options.hardships, [&](std::string_view name, auto& value, std::string_view, Range) {
        std::string before;
        internal::ForEachField(none,
                               [&](std::string_view other, auto& plain, std::string_view, Range) {
                                 if (other == name) before = internal::ValueToText(plain);
                               });
        const bool same = internal::ValueToText(value) == before;
        EXPECT_EQ(same, others.contains(std::string(name))) << name;
      });
}

TEST(RealisticStreet, KeepsNumberSizeSpacingAndSeed) {
  const StreetOptions options =
      RealisticStreet({.panoramas = 7, .width_px = 128, .spacing_m = 9.0, .seed = 5});
  EXPECT_EQ(options.panoramas, 7);
  EXPECT_EQ(options.width_px, 128);
  EXPECT_EQ(options.spacing_m, 9.0);
  EXPECT_EQ(options.seed, 5);
}

}  // namespace
}  // namespace orbweave
