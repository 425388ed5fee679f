// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/gnss_ways.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/shortest_half.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/registration/gnss_steps.h"

namespace orbweave {
namespace {

constexpr size_t kLongestWay = 2;
/// Ways of so many places on either side.
constexpr size_t kWaysAbout = kLongestWay * 15;
constexpr double kUnitShare = 0.05;
constexpr double kMaxSquare = 25.0;

/// Lengths in metres at first.
std::vector<GnssWay> WaysInMetres(const MappingState& state, const RegisteredSequence& places) {
  std::vector<GnssWay> ways;
  for (size_t place = 0; place < places.size(); ++place) {
    const ImageSlot image = places.At(place);
    for (size_t span = 1; span <= kLongestWay && place + span < places.size(); ++span) {
      const ImageSlot next = places.At(place + span);
      if (places.LineOf(next) != places.LineOf(image)) break;
      const GnssStep step = StepBetween(state.Problem(), image, next);
      const double length_m = std::exp(step.log_length);
      if (std::isfinite(step.sigma) && state.Centre(next) != state.Centre(image))
        ways.push_back({image, next, length_m, step.sigma * length_m, span == 1});
    }
  }
  return ways;
}

double LengthOf(const MappingState& state, const GnssWay& way) {
  return (state.Centre(way.next) - state.Centre(way.image)).norm();
}

double MetresPerUnit(const MappingState& state, std::span<const GnssWay> ways) {
  std::vector<double> logs;
  for (const GnssWay& way : ways) logs.push_back(std::log(way.length / LengthOf(state, way)));
  const Interval half = ShortestHalf(std::move(logs));
  return std::exp(0.5 * (half.low + half.high));
}

bool IsWithinDrive(const MappingState& state, const GnssWay& way) {
  return state.Problem().images[way.image].drive == state.Problem().images[way.next].drive;
}

/// How many times their stated sigmas ways within drives are off, or those between two of them.
double FactorOf(const MappingState& state, std::span<const GnssWay> ways, bool within_drives) {
  std::vector<double> errors;
  for (const GnssWay& way : ways) {
    if (IsWithinDrive(state, way) == within_drives) errors.push_back(std::abs(way.Misfit(state)));
  }
  return FactorOfErrors(std::move(errors));
}

double SquareOf(const GnssWay& way, const MappingState& state) {
  const double misfit = way.Misfit(state);
  return std::min(misfit * misfit, kMaxSquare);
}

}  // namespace

double GnssWay::Misfit(const MappingState& state) const {
  return (LengthOf(state, *this) - length) / sigma;
}

GnssWays::GnssWays(const MappingState& state, double tolerance_px) {
  const RegisteredSequence places(state, tolerance_px);
  const std::vector<GnssWay> in_metres = WaysInMetres(state, places);
  ways_ = in_metres;
  for (size_t i = 0; i < ways_.size(); ++i) {
    const size_t first = i - std::min(i, kWaysAbout);
    const size_t last = std::min(ways_.size(), i + kWaysAbout + 1);
    const double metres_per_unit =
        MetresPerUnit(state, std::span(in_metres).subspan(first, last - first));
    ways_[i].length /= metres_per_unit;
    ways_[i].sigma /= metres_per_unit;
  }
  const double within = FactorOf(state, ways_, true);
  const double between = FactorOf(state, ways_, false);
  for (GnssWay& way : ways_) {
    const double factor = IsWithinDrive(state, way) ? within : between;
    way.sigma = std::hypot(factor * way.sigma, kUnitShare * way.length);
  }
  for (size_t i = 0; i < ways_.size(); ++i) place_of_way_[{ways_[i].image, ways_[i].next}] = i;
}

const GnssWay* GnssWays::WayToNext(ImageSlot image, ImageSlot next) const {
  const auto place = place_of_way_.find({image, next});
  if (place == place_of_way_.end() || !ways_[place->second].leads_to_next) return nullptr;
  return &ways_[place->second];
}

double GnssWays::Misfit(const MappingState& state) const {
  double sum = 0.0;
  for (const GnssWay& way : ways_) sum += SquareOf(way, state);
  return sum;
}

double GnssWays::MisfitAtEdges(const MappingState& state, const CandidateMove& images) const {
  double sum = 0.0;
  for (const GnssWay& way : ways_) {
    if (images.contains(way.image) != images.contains(way.next)) sum += SquareOf(way, state);
  }
  return sum;
}

}  // namespace orbweave
