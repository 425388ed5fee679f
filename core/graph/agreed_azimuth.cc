// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/agreed_azimuth.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "core/graph/azimuth.h"

namespace orbweave {
namespace {

constexpr size_t kFewest = 3;

/// The votes within `agree_rad` of one of them that weigh most: [first, first + count) of `votes`,
/// which are sorted and come three times, each time a turn further.
struct Window {
  size_t first = 0;
  size_t count = 0;
  double weight = 0.0;
};

Window HeaviestWindow(const std::vector<AzimuthVote>& votes, size_t num_votes, double agree_rad) {
  Window best;
  size_t first = 0;
  size_t end = 0;
  double weight = 0.0;
  for (size_t centre = 0; centre < num_votes; ++centre) {
    // Centres are the votes of the second time, so that a window begins and ends among them.
    const double azimuth_rad = votes[centre + num_votes].azimuth_rad;
    while (end < votes.size() && votes[end].azimuth_rad <= azimuth_rad + agree_rad)
      weight += votes[end++].weight;
    while (votes[first].azimuth_rad < azimuth_rad - agree_rad) weight -= votes[first++].weight;
    if (weight > best.weight) best = {first, end - first, weight};
  }
  return best;
}

}  // namespace

std::optional<double> AgreedAzimuth(std::vector<AzimuthVote> votes, double agree_rad) {
  if (votes.size() < kFewest) return std::nullopt;
  double all = 0.0;
  for (AzimuthVote& vote : votes) {
    vote.azimuth_rad = WrappedAzimuth(vote.azimuth_rad);
    all += vote.weight;
  }
  std::ranges::stable_sort(votes, {}, &AzimuthVote::azimuth_rad);
  const size_t num_votes = votes.size();
  for (const int turn : {1, 2}) {
    for (size_t i = 0; i < num_votes; ++i) {
      AzimuthVote again = votes[i];
      again.azimuth_rad += turn * 2.0 * std::numbers::pi;
      votes.push_back(again);
    }
  }
  const Window window = HeaviestWindow(votes, num_votes, agree_rad);
  if (window.count < kFewest || !(window.weight > 0.5 * all)) return std::nullopt;
  double sum = 0.0;
  double weights = 0.0;
  for (size_t i = window.first; i < window.first + window.count; ++i) {
    const double weight = votes[i].weight / votes[i].sigma_rad;
    sum += weight * votes[i].azimuth_rad;
    weights += weight;
  }
  return sum / weights;
}

}  // namespace orbweave
