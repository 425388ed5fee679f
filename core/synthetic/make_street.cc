// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/make_street.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "core/base/quantile.h"
#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/synthetic/measure_street.h"
#include "core/synthetic/random_for_street.h"
#include "core/synthetic/room_world.h"
#include "core/synthetic/second_day.h"

namespace orbweave {
namespace {

std::string NameOf(size_t i) {
  char name[40];
  std::snprintf(name, sizeof(name), "street_%04zu.jpg", i);
  return name;
}

/// cam_from_street of a carrier on the axis: forward along it, up to sway. A slow one does not jump
/// aside between two panoramas.
Rigid3 PoseAt(const PathPlace& place, const StreetOptions& options, Random& random) {
  const double aside_m = std::min(0.2, options.spacing_m);
  const double up_m = std::min(0.03, 0.15 * options.spacing_m);
  Eigen::Matrix3d R;
  R.row(0) << place.direction.y(), -place.direction.x(), 0.0;  // right
  R.row(1) << 0.0, 0.0, -1.0;                                  // down
  R.row(2) << place.direction.x(), place.direction.y(), 0.0;   // forward
  const double sigma_rad = options.tilt_sigma_deg * std::numbers::pi / 180.0;
  const Eigen::Vector3d sway(random.Normal(), random.Normal(), random.Normal());
  const Eigen::Vector2d ground = place.position + random.Uniform(-aside_m, aside_m) * place.Left();
  const Eigen::Vector3d centre(ground.x(), ground.y(), random.Uniform(-up_m, up_m));
  const Eigen::Quaterniond tilt = RotationFromVector(sigma_rad * sway);
  return Rigid3::FromCentre((tilt * Eigen::Quaterniond(R)).normalized(), centre);
}

/// Whether a panorama is of the place of the one before.
bool Stands(const StreetHardships& hardships, size_t i, size_t n) {
  if (hardships.standing) return i > 0;
  const auto stop = std::min(static_cast<size_t>(hardships.stop_panoramas), n);
  const size_t begin = (n - stop) / 2;
  return i > begin && i < begin + stop;
}

/// Arc lengths of the panoramas. A drive that closes the loop spaces them evenly round it.
std::vector<double> StationsOf(const StreetOptions& options, const StreetPath& axis) {
  const auto n = static_cast<size_t>(options.panoramas);
  if (options.hardships.standing) return std::vector<double>(n, 0.0);
  const double length_m = options.panoramas * options.spacing_m;
  const double step_m = length_m < axis.length_m() - options.spacing_m
                            ? options.spacing_m
                            : axis.length_m() / options.panoramas;
  Random random = RandomForStreet(options, "spacing");
  std::vector<double> stations_m;
  double steps = 0.0;
  for (size_t i = 0; i < n; ++i) {
    // Places shift by up to half the spread, so that steps change by up to the whole of it.
    const double shift = 0.5 * options.hardships.spacing_spread * random.Uniform(-1.0, 1.0);
    const bool stands = Stands(options.hardships, i, n);
    stations_m.push_back(stands ? stations_m.back() : (steps + shift) * step_m);
    steps += stands ? 0.0 : 1.0;
  }
  return stations_m;
}

/// Stretches of the second day alternate with those of the first; 20 panoramas together.
std::vector<bool> SecondDayOfEach(const StreetOptions& options) {
  constexpr double kPeriod = 20.0;
  const double share = options.hardships.second_day_share;
  Random random = RandomForStreet(options, "days");
  const double start = kPeriod * random.Uniform(0.3, 0.7);
  std::vector<bool> second;
  for (int i = 0; i < options.panoramas; ++i) {
    const double phase = (i + start) / kPeriod;
    second.push_back(phase - std::floor(phase) >= 1.0 - share);
  }
  return second;
}

std::vector<double> CaptureTimes(const Street& street, const StreetHardships& hardships) {
  constexpr double kFirstDay_s = 1.7e9;
  constexpr double kDaysBetween_s = 86400.0 * 23.0;
  std::vector<double> times_s;
  double stood_s = 0.0;
  for (size_t i = 0; i < street.stations_m.size(); ++i) {
    if (Stands(hardships, i, street.stations_m.size())) stood_s += 0.5;
    const double since_start_s = street.stations_m[i] / hardships.speed_mps + stood_s;
    times_s.push_back(kFirstDay_s + since_start_s +
                      (street.on_second_day[i] ? kDaysBetween_s : 0.0));
  }
  return times_s;
}

StreetWorld MakeWorld(const StreetOptions& options) {
  const double length_m = options.panoramas * options.spacing_m;
  const uint64_t seed = RandomForStreet(options, "world").Next();
  if (options.hardships.room) return MakeRoomWorld(length_m, seed);
  return MakeStreetWorld(length_m, seed, options.hardships);
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
    median[axis] = UpperMedian(std::move(values));
  }
  return median;
}

}  // namespace

Street MakeStreet(const StreetOptions& options) {
  const auto n = static_cast<size_t>(options.panoramas);
  Street street{.world = MakeWorld(options), .origin = {22.3, 114.17, 10.0}};
  street.stations_m = StationsOf(options, street.world.layout.axis);
  street.on_second_day = SecondDayOfEach(options);
  street.capture_times_s = CaptureTimes(street, options.hardships);
  if (options.hardships.second_day_share > 0.0) {
    street.second_day = SecondDayOf(street.world, RandomForStreet(options, "second day").Next());
  }
  Random sway = RandomForStreet(options, "sway");
  std::vector<Rigid3> cams_from_street;
  std::vector<Eigen::Vector3d> centres;
  for (size_t i = 0; i < n; ++i) {
    street.names.push_back(NameOf(i));
    const PathPlace place = street.world.layout.axis.At(street.stations_m[i]);
    cams_from_street.push_back(Stands(options.hardships, i, n) ? cams_from_street.back()
                                                               : PoseAt(place, options, sway));
    centres.push_back(cams_from_street.back().Centre());
  }
  street.measured_in_enu = MeasureStreet(street, centres, options);
  street.street_in_enu = -MedianOf(street.measured_in_enu);
  for (auto& position : street.measured_in_enu) {
    if (position) *position += street.street_in_enu;
  }
  const Rigid3 street_from_enu{Eigen::Quaterniond::Identity(), -street.street_in_enu};
  for (const Rigid3& cam : cams_from_street) street.cams_from_enu.push_back(cam * street_from_enu);
  return street;
}

}  // namespace orbweave
