// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_look_alikes.h"

#include <algorithm>
#include <string>

namespace orbweave {
namespace {

size_t CountDropped(const JobResults& results, DropCause cause) {
  return static_cast<size_t>(std::ranges::count_if(
      results.view_graph.dropped, [&](const DroppedEdge& edge) { return edge.cause == cause; }));
}

}  // namespace

CrossCheck CheckLookAlikes(const JobResults& results) {
  const size_t by_sequence = CountDropped(results, DropCause::kSequence);
  const size_t by_gnss = CountDropped(results, DropCause::kGnss);
  CrossCheck check{
      .name = "look_alikes", .value = static_cast<double>(by_sequence + by_gnss), .unit = "count"};
  check.sentence = "verified pairs of places that only look alike: " + std::to_string(by_sequence) +
                   " told apart by the sequence of their drive, " + std::to_string(by_gnss) +
                   " by GNSS";
  return check;
}

}  // namespace orbweave
