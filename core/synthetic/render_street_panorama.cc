// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/render_street_panorama.h"

#include <algorithm>
#include <cmath>

#include "core/synthetic/camera_rays.h"
#include "core/synthetic/random_for_street.h"
#include "core/synthetic/street_solids.h"
#include "core/synthetic/street_traffic.h"

namespace orbweave {
namespace {

/// Crowns of trees pushed aside, each by its own gust, with other leaves to be seen; clouds go by.
StreetWorld InTheWind(StreetWorld world, double wind_m, double since_start_s, Random random) {
  for (Solid& solid : world.solids) {
    if (solid.kind != SolidKind::kCrown) continue;
    for (const int axis : {0, 1, 2}) solid.centre[axis] += wind_m * random.Normal();
    solid.leaves = 1 + random.Index(1U << 20);
  }
  // Clouds a kilometre up move with 8 m/s.
  world.light.cloud_drift = 0.008 * since_start_s * Eigen::Vector2d(0.8, 0.6);
  world.grid = SolidGrid(world.solids);
  return world;
}

/// The carrier follows the axis at its speed.
RollingShutter ShutterAt(const Street& street, const StreetHardships& hardships, size_t i) {
  if (hardships.rolling_shutter_s == 0.0 || hardships.standing) return {};
  constexpr double kStep_m = 0.5;
  const StreetPath& axis = street.world.layout.axis;
  const double s = street.stations_m[i];
  const Eigen::Vector2d before = axis.At(s - kStep_m).direction;
  const Eigen::Vector2d after = axis.At(s + kStep_m).direction;
  const double turn_rad =
      std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  const Eigen::Vector2d velocity = hardships.speed_mps * axis.At(s).direction;
  return {.readout_s = hardships.rolling_shutter_s,
          .velocity_mps = {velocity.x(), velocity.y(), 0.0},
          .yaw_rate_rad_s = turn_rad / (2.0 * kStep_m) * hardships.speed_mps};
}

std::vector<Solid> MovingAt(const Street& street,
                            const StreetOptions& options,
                            size_t i,
                            Random& random) {
  if (options.hardships.room) return {};
  const StreetLayout& layout = street.world.layout;
  const double station_m = street.stations_m[i];
  std::vector<Solid> moving = MakeMovingCars(layout, station_m, random);
  Random passing = RandomForStreet(options, "passers", i);
  const std::vector<Solid> passers = MakePassers(layout, station_m, options.hardships, passing);
  moving.insert(moving.end(), passers.begin(), passers.end());
  if (!options.hardships.bus_ahead) return moving;
  const Solid bus = MakeBusAhead(layout, station_m);
  std::erase_if(moving, [&](const Solid& other) {  // nobody drives inside the bus
    return (other.centre - bus.centre).head<2>().norm() < bus.half.x() + 2.5;
  });
  moving.push_back(bus);
  return moving;
}

PanoramaView ViewAt(const Street& street, const StreetOptions& options, size_t i, Random& random) {
  const StreetHardships& hardships = options.hardships;
  const Rigid3 enu_from_street{Eigen::Quaterniond::Identity(), street.street_in_enu};
  PanoramaView view{
      .camera = {options.width_px, options.width_px / 2},
      .cam_from_street = street.cams_from_enu[i] * enu_from_street,
      .exposure = 1.0 + random.Uniform(-options.exposure_spread, options.exposure_spread),
      .noise_levels = options.noise_levels,
      .mask_traffic = options.mask_moving_cars,
      .seed = static_cast<uint32_t>(random.Next() >> 32),
      .shade_noise_levels = hardships.shade_noise_levels,
      .shade_blur_px = hardships.shade_blur_px,
      .nadir = hardships.nadir,
      .lenses = {.offset_m = hardships.lens_offset_m, .vignetting = hardships.vignetting},
      .shutter = ShutterAt(street, hardships, i)};
  // The gain that makes up for half the missing light, in stops, raises the noise as much.
  const double gain = 1.0 / std::sqrt(hardships.daylight);
  view.exposure /= gain;
  view.noise_levels *= gain;
  Random tint = RandomForStreet(options, "white balance", i);
  const double spread = hardships.white_balance_spread;
  view.white_balance.x() = 1.0 + tint.Uniform(-spread, spread);
  view.white_balance.z() = 1.0 + tint.Uniform(-spread, spread);
  return view;
}

}  // namespace

StreetMoment MomentOf(const Street& street, const StreetOptions& options, size_t i) {
  Random random = RandomForStreet(options, "shot", i);
  const PanoramaView view = ViewAt(street, options, i, random);
  StreetMoment moment{.view = view,
                      .at_rest = street.WorldOf(i),
                      .traffic = Traffic(MovingAt(street, options, i, random))};
  const double wind_m = options.hardships.wind_m;
  if (wind_m == 0.0) return moment;
  const double since_start_s = street.capture_times_s[i] - street.capture_times_s[0];
  const Random gusts = RandomForStreet(options, "wind", i);
  moment.in_the_wind.emplace(InTheWind(moment.at_rest, wind_m, since_start_s, gusts));
  return moment;
}

RenderedPanorama RenderStreetPanorama(const Street& street,
                                      const StreetOptions& options,
                                      size_t i) {
  const StreetMoment moment = MomentOf(street, options, i);
  return RenderPanorama(moment.World(), moment.traffic, moment.view);
}

}  // namespace orbweave
