// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/check_contradicted_pairs.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/report/borne_out_by_gnss.h"
#include "core/report/model_of_images.h"

namespace orbweave {
namespace {

// A verified geometry is accepted by its inliers with odds of chance far below one in a hundred, so
// a right model contradicts about as few; five times as many leave room for what moves: vehicles,
// and pairs whose overlap lies on a carrier. Look-alike places and folds contradict pairs by the
// run.
constexpr double kExpectedShare = 0.05;
// The witnesses against the model outnumber those for it.
constexpr double kMajority = 0.5;

}  // namespace

std::optional<CrossCheck> CheckContradictedPairs(const JobResults& results) {
  const std::vector<int> model_of_image = ModelOfImages(results);
  const BorneOutByGnss gnss(results);
  const auto is_judged = [&](const ImagePair& pair) {
    return AreOfOneModel(model_of_image, pair) && !gnss.AreApart(pair);
  };
  std::set<ImagePair> judged;
  std::ranges::copy_if(results.view_graph.edges, std::inserter(judged, judged.end()), is_judged);
  std::set<ImagePair> contradicted;
  for (const ClusterSummary& cluster : results.clusters) {
    std::ranges::copy_if(
        cluster.contradicted_pairs, std::inserter(contradicted, contradicted.end()), is_judged);
  }
  judged.insert(contradicted.begin(), contradicted.end());
  if (judged.empty()) return std::nullopt;
  CrossCheck check{
      .name = "pairs_contradicted",
      .value = static_cast<double>(contradicted.size()) / static_cast<double>(judged.size()),
      .limit = kExpectedShare,
      .unit = "share"};
  check.level = check.value > kMajority        ? CheckLevel::kBad
                : check.value > kExpectedShare ? CheckLevel::kDoubtful
                                               : CheckLevel::kGood;
  check.sentence = std::to_string(contradicted.size()) + " of " + std::to_string(judged.size()) +
                   " verified pairs contradict the model";
  if (contradicted.empty()) return check;
  check.sentence += ", first " + results.manifest.At(contradicted.begin()->a).name + " and " +
                    results.manifest.At(contradicted.begin()->b).name;
  if (check.level != CheckLevel::kGood) {
    check.sentence +=
        ": places that look alike, or a model folded onto itself; compare both pictures, and give "
        "GNSS positions where they differ";
  }
  return check;
}

}  // namespace orbweave
