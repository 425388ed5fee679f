// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "core/mapping/lengths/pair_length.h"
#include "core/mapping/lengths/ray_depths.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// What is measured once to tell how long the pairs of a model are: the pairs that take part
/// (LogLengthOfPair), as indices into the graph's, their lengths in the model, and the depths that
/// each gives to its rays (MeasureRayDepths). Refers to the state.
struct AskedRays {
  const MappingState& state;
  std::vector<uint32_t> pairs{};
  std::vector<double> log_lengths{};
  std::vector<RayDepth> depths{};  ///< their pairs are positions in `pairs`
  double max_error_px = 4.0;

  AskedRays(const MappingState& of_state, const MappingOptions& options);
};

/// Rays of one image that tell how long one pair is.
struct RayCount {
  size_t told = 0;
  size_t agreeing = 0;

  void Add(double told_log_length, double log_length, double tolerance);
};

/// Of one pair, by one of its images or both: eight rays of an image at least, 200 in all at most.
[[nodiscard]] LengthAgreement AgreementOf(std::initializer_list<RayCount> sides);

}  // namespace orbweave
