// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/check_contradicted_pairs.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/report/model_of_images.h"

namespace orbweave {
namespace {

// A verified geometry is accepted by its inliers with odds of chance far below one in a hundred, so
// a right model contradicts about as few; five times as many leave room for what moves: vehicles,
// and pairs whose overlap lies on a carrier.
constexpr double kExpectedShare = 0.05;
// The witnesses against the model, or against the place of an image, are as many as those for it.
constexpr double kMajority = 0.5;
// One pair of an image with two is chance.
constexpr size_t kFewestOfImage = 2;

/// The pairs of an image.
struct PairsOfImage {
  size_t contradicted = 0;
  size_t all = 0;

  [[nodiscard]] double Share() const {
    return static_cast<double>(contradicted) / static_cast<double>(all);
  }
  [[nodiscard]] bool AreAgainstIt() const {
    return contradicted >= kFewestOfImage && Share() >= kMajority;
  }
};

/// The image against which most of its pairs speak, by share; nullopt where none has most of them
/// against it.
std::optional<std::pair<ImageId, PairsOfImage>> MostContested(
    const std::set<ImagePair>& judged, const std::set<ImagePair>& contradicted) {
  std::map<ImageId, PairsOfImage> pairs_of_image;
  for (const ImagePair& pair : judged) {
    for (const ImageId image : {pair.a, pair.b}) {
      ++pairs_of_image[image].all;
      pairs_of_image[image].contradicted += contradicted.contains(pair) ? 1 : 0;
    }
  }
  std::optional<std::pair<ImageId, PairsOfImage>> worst;
  for (const auto& [image, pairs] : pairs_of_image) {
    if (pairs.AreAgainstIt() && (!worst || pairs.Share() > worst->second.Share()))
      worst = {image, pairs};
  }
  return worst;
}

}  // namespace

std::optional<CrossCheck> CheckContradictedPairs(const JobResults& results,
                                                 const PairsOfJob& of_job,
                                                 const BorneOutByGnss& gnss) {
  const std::vector<int> model_of_image = ModelOfImages(results);
  const auto is_judged = [&](const ImagePair& pair) {
    return AreOfOneModel(model_of_image, pair) && !gnss.AreApart(pair);
  };
  std::set<ImagePair> judged;
  std::ranges::copy_if(results.view_graph.edges, std::inserter(judged, judged.end()), is_judged);
  std::set<ImagePair> contradicted = of_job.contradicted;
  std::erase_if(contradicted, [&](const ImagePair& pair) { return !is_judged(pair); });
  judged.insert(contradicted.begin(), contradicted.end());
  if (judged.empty()) return std::nullopt;
  CrossCheck check{
      .name = "pairs_contradicted",
      .value = static_cast<double>(contradicted.size()) / static_cast<double>(judged.size()),
      .limit = kExpectedShare,
      .unit = "share"};
  check.sentence = std::to_string(contradicted.size()) + " of " + std::to_string(judged.size()) +
                   " verified pairs contradict the model";
  if (contradicted.empty()) return check;
  check.sentence += ", first " + results.manifest.At(contradicted.begin()->a).name + " and " +
                    results.manifest.At(contradicted.begin()->b).name;
  if (check.value <= kExpectedShare) return check;
  const auto contested = MostContested(judged, contradicted);
  if (!contested) check.limit = kMajority;
  if (check.IsWithinLimit()) {
    check.sentence += ", and most pairs of every panorama agree with it: places that look alike";
    return check;
  }
  check.level = check.value > kMajority ? CheckLevel::kBad : CheckLevel::kDoubtful;
  if (contested) {
    const auto& [image, pairs] = *contested;
    check.sentence += "; of " + std::to_string(pairs.all) + " pairs of " +
                      results.manifest.At(image).name + " " + std::to_string(pairs.contradicted);
  }
  check.sentence +=
      ": places that look alike, or a model folded onto itself; compare both pictures, and give "
      "GNSS positions where they differ";
  return check;
}

}  // namespace orbweave
