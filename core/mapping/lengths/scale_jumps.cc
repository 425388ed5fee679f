// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/scale_jumps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/ray_depths.h"
#include "core/mapping/lengths/registered_sequence.h"

namespace orbweave {
namespace {

constexpr size_t kPerSide = 3;

/// A logarithm of each place of a sequence; none where nothing is told.
using Logs = std::vector<std::optional<double>>;

/// How far the rays of each image reach.
Logs LogReaches(const AskedRays& asked, const RegisteredSequence& places) {
  std::vector<std::vector<double>> reaches(places.size());
  for (const RayDepth& depth : asked.depths) {
    const ImageSlot image = asked.state.Graph().image_of_node[depth.node];
    reaches[places.PlaceOf(image)].push_back(asked.log_lengths[depth.pair] + depth.log_depth);
  }
  Logs medians(places.size());
  for (size_t place = 0; place < places.size(); ++place) {
    if (reaches[place].size() >= kFewestRaysOfPair)
      medians[place] = Quantile(std::move(reaches[place]), 0.5);
  }
  return medians;
}

/// How long the step from each image to the next of its line is.
Logs LogSteps(const MappingState& state, const RegisteredSequence& places) {
  Logs steps(places.size());
  for (size_t place = 0; place + 1 < places.size(); ++place) {
    const ImageSlot image = places.At(place);
    const ImageSlot next = places.At(place + 1);
    const double length = (state.Centre(next) - state.Centre(image)).norm();
    if (places.LineOf(image) == places.LineOf(next) && length > 0.0)
      steps[place] = std::log(length);
  }
  return steps;
}

std::optional<double> MedianOf(std::span<const std::optional<double>> logs) {
  std::vector<double> known;
  for (const std::optional<double>& log : logs) {
    if (log) known.push_back(*log);
  }
  if (known.empty()) return std::nullopt;
  return Quantile(std::move(known), 0.5);
}

/// From the values before a place to those from `behind` on, up to three each within [first, end);
/// 0 where a side has none.
double JumpOf(const Logs& logs, size_t first, size_t before, size_t behind, size_t end) {
  const size_t from = std::max(first, before - std::min(before, kPerSide));
  const size_t to = std::min(end, behind + kPerSide);
  if (from >= before || behind >= to) return 0.0;
  const std::span all(logs);
  const std::optional<double> left = MedianOf(all.subspan(from, before - from));
  const std::optional<double> right = MedianOf(all.subspan(behind, to - behind));
  return left && right ? *right - *left : 0.0;
}

/// One past the last place of the line that begins at a place.
size_t EndOfLine(const RegisteredSequence& places, size_t first) {
  size_t end = first;
  while (end < places.size() && places.LineOf(places.At(end)) == places.LineOf(places.At(first)))
    ++end;
  return end;
}

}  // namespace

std::map<ImageSlot, double> MeasureScaleJumps(const AskedRays& asked) {
  const RegisteredSequence places(asked.state, kMatchTolerance * asked.max_error_px);
  const Logs reaches = LogReaches(asked, places);
  const Logs steps = LogSteps(asked.state, places);
  std::map<ImageSlot, double> jumps;
  for (size_t first = 0; first < places.size();) {
    const size_t end = EndOfLine(places, first);
    for (size_t place = first; place + 1 < end; ++place) {
      const double of_steps = JumpOf(steps, first, place, place + 1, end - 1);
      const double of_reaches = JumpOf(reaches, first, place + 1, place + 1, end);
      jumps[places.At(place)] =
          of_steps * of_reaches > 0.0 ? std::min(std::abs(of_steps), std::abs(of_reaches)) : 0.0;
    }
    first = end;
  }
  return jumps;
}

}  // namespace orbweave
