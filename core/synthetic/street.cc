// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/synthetic/simulate_gnss.h"
#include "core/synthetic/street_solids.h"

namespace orbweave {
namespace {

/// Independent random numbers for each purpose and panorama.
Random RandomFor(const StreetOptions& options, const char* purpose, size_t i = 0) {
  return Random("street/" + std::to_string(options.seed) + "/" + purpose + "/" + std::to_string(i));
}

std::string NameOf(size_t i) {
  char name[40];
  std::snprintf(name, sizeof(name), "street_%04zu.jpg", i);
  return name;
}

/// cam_from_street of a carrier on the axis: forward along it, up to sway.
Rigid3 PoseAt(const PathPlace& place, double tilt_sigma_deg, Random& random) {
  Eigen::Matrix3d R;
  R.row(0) << place.direction.y(), -place.direction.x(), 0.0;  // right
  R.row(1) << 0.0, 0.0, -1.0;                                  // down
  R.row(2) << place.direction.x(), place.direction.y(), 0.0;   // forward
  const double sigma_rad = tilt_sigma_deg * std::numbers::pi / 180.0;
  const Eigen::Vector3d sway(random.Normal(), random.Normal(), random.Normal());
  const Eigen::Vector2d ground = place.position + random.Uniform(-0.2, 0.2) * place.Left();
  const Eigen::Vector3d centre(ground.x(), ground.y(), random.Uniform(-0.03, 0.03));
  const Eigen::Quaterniond tilt = RotationFromVector(sigma_rad * sway);
  return Rigid3::FromCentre((tilt * Eigen::Quaterniond(R)).normalized(), centre);
}

/// Measurements in the street's frame, without those of one tunnel-like gap in the last third.
std::vector<std::optional<Eigen::Vector3d>> Measure(const StreetOptions& options,
                                                    const std::vector<Rigid3>& cams_from_street) {
  std::vector<Eigen::Vector3d> centres;
  for (const Rigid3& cam : cams_from_street) centres.push_back(cam.Centre());
  const GnssModel model{options.gnss_sigma_m, options.gnss_bias_m, options.gnss_outlier_share};
  const std::vector<Eigen::Vector3d> positions =
      SimulateGnss(centres, model, RandomFor(options, "gnss").Next());
  std::vector<std::optional<Eigen::Vector3d>> measured(positions.begin(), positions.end());
  const auto n = static_cast<double>(measured.size());
  const auto first = static_cast<size_t>(n * 2.0 / 3.0 * (1.0 - options.gnss_gap_share));
  const auto count = static_cast<size_t>(n * options.gnss_gap_share);
  for (size_t i = first; i < std::min(measured.size(), first + count); ++i) measured[i].reset();
  return measured;
}

/// Median of each coordinate, zero when there is nothing.
Eigen::Vector3d MedianOf(const std::vector<std::optional<Eigen::Vector3d>>& positions) {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& position : positions) {
      if (position) values.push_back((*position)[axis]);
    }
    if (values.empty()) return median;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median[axis] = *middle;
  }
  return median;
}

}  // namespace

Street MakeStreet(const StreetOptions& options) {
  const auto n = static_cast<size_t>(options.panoramas);
  const double length_m = options.panoramas * options.spacing_m;
  Street street{.world = MakeStreetWorld(length_m, RandomFor(options, "world").Next()),
                .origin = {22.3, 114.17, 10.0}};
  const StreetPath& axis = street.world.layout.axis;
  // A drive that closes the loop spaces its panoramas evenly round it.
  const double step_m = length_m < axis.length_m() - options.spacing_m
                            ? options.spacing_m
                            : axis.length_m() / options.panoramas;
  Random sway = RandomFor(options, "sway");
  std::vector<Rigid3> cams_from_street;
  for (size_t i = 0; i < n; ++i) {
    street.names.push_back(NameOf(i));
    street.stations_m.push_back(static_cast<double>(i) * step_m);
    cams_from_street.push_back(PoseAt(axis.At(street.stations_m[i]), options.tilt_sigma_deg, sway));
  }
  street.measured_in_enu = Measure(options, cams_from_street);
  street.street_in_enu = -MedianOf(street.measured_in_enu);
  for (auto& position : street.measured_in_enu) {
    if (position) *position += street.street_in_enu;
  }
  const Rigid3 street_from_enu{Eigen::Quaterniond::Identity(), -street.street_in_enu};
  for (const Rigid3& cam : cams_from_street) street.cams_from_enu.push_back(cam * street_from_enu);
  return street;
}

RenderedPanorama RenderStreetPanorama(const Street& street,
                                      const StreetOptions& options,
                                      size_t i) {
  Random random = RandomFor(options, "shot", i);
  const Rigid3 enu_from_street{Eigen::Quaterniond::Identity(), street.street_in_enu};
  const PanoramaView view{
      .camera = {options.width_px, options.width_px / 2},
      .cam_from_street = street.cams_from_enu[i] * enu_from_street,
      .exposure = 1.0 + random.Uniform(-options.exposure_spread, options.exposure_spread),
      .noise_levels = options.noise_levels,
      .mask_traffic = options.mask_moving_cars,
      .seed = static_cast<uint32_t>(random.Next() >> 32)};
  const Traffic traffic(MakeMovingCars(street.world.layout, street.stations_m[i], random));
  return RenderPanorama(street.world, traffic, view);
}

}  // namespace orbweave
