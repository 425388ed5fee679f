// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/median_error.h"

#include <utility>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr size_t kEnough = 100;

std::vector<double> ErrorsOfTracks(const MappingState& state, size_t min_length) {
  std::vector<double> errors_px;
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    const MappedPoint& mapped = state.Point(point);
    if (mapped.nodes.size() < min_length) continue;
    for (const Node node : mapped.nodes) {
      errors_px.push_back(NodeError(state, mapped.position, node) /
                          AngleFromPixels(state, node, 1.0));
    }
  }
  return errors_px;
}

}  // namespace

double MedianErrorPx(const MappingState& state) {
  std::vector<double> errors_px = ErrorsOfTracks(state, 3);
  if (errors_px.size() < kEnough) errors_px = ErrorsOfTracks(state, 2);
  if (errors_px.empty()) return 0.0;
  return UpperMedian(std::move(errors_px));
}

}  // namespace orbweave
