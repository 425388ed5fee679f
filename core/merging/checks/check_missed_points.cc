// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_missed_points.h"

#include <algorithm>
#include <string>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr uint32_t kFewestAsked = 50;
constexpr double kOfUsual = 0.125;
constexpr double kLeastShare = 0.03;

double ShareOf(const SeenBetween& count) {
  return static_cast<double>(count.seen) / static_cast<double>(count.asked);
}

/// Of images that are asked for enough, each once, sorted.
std::vector<SeenBetween> Summed(const std::vector<SeenBetween>& counts,
                                const std::map<ImageId, RegisteredImage>& images) {
  std::map<ImageId, SeenBetween> of_image;
  for (const SeenBetween& count : counts) {
    const auto image = images.find(count.image);
    if (image == images.end() || image->second.loose) continue;
    SeenBetween& sum = of_image[count.image];
    sum.image = count.image;
    sum.asked += count.asked;
    sum.seen += count.seen;
  }
  std::vector<SeenBetween> summed;
  for (const auto& [id, sum] : of_image) {
    if (sum.asked >= kFewestAsked) summed.push_back(sum);
  }
  return summed;
}

/// The least share that is not doubted; of some.
double LeastShare(const std::vector<SeenBetween>& summed) {
  std::vector<double> shares;
  for (const SeenBetween& count : summed) shares.push_back(ShareOf(count));
  return std::max(kLeastShare, kOfUsual * Quantile(std::move(shares), 0.5));
}

}  // namespace

CrossCheck CheckMissedPoints(const std::vector<SeenBetween>& counts,
                             const std::map<ImageId, RegisteredImage>& images,
                             const ImageManifest& manifest) {
  CrossCheck check{.name = "missed_points", .unit = "share", .bound = CheckBound::kAtLeast};
  const std::vector<SeenBetween> summed = Summed(counts, images);
  if (summed.empty()) {
    check.sentence = "no panorama stands between others that see what it should see";
    return check;
  }
  check.limit = LeastShare(summed);
  const SeenBetween& worst = *std::ranges::min_element(summed, {}, ShareOf);
  check.value = ShareOf(worst);
  if (check.IsWithinLimit()) {
    check.sentence = std::to_string(summed.size()) +
                     " panoramas see what others see from either side of them, as often as is "
                     "usual in this model";
    return check;
  }
  check.level = CheckLevel::kDoubtful;
  const auto off = std::ranges::count_if(
      summed, [&](const SeenBetween& count) { return ShareOf(count) < check.limit; });
  check.sentence = std::to_string(off) + " of " + std::to_string(summed.size()) +
                   " panoramas hardly see what others see from either side of them, first " +
                   manifest.At(worst.image).name + ": " + std::to_string(worst.seen) + " of " +
                   std::to_string(worst.asked) +
                   " points; it may stand elsewhere: compare it with its neighbours, or leave it "
                   "out";
  return check;
}

std::vector<SeenBetween> ImagesThatMissPoints(const std::vector<SeenBetween>& counts,
                                              const std::map<ImageId, RegisteredImage>& images) {
  std::vector<SeenBetween> summed = Summed(counts, images);
  if (summed.empty()) return {};
  const double least = LeastShare(summed);
  std::erase_if(summed, [&](const SeenBetween& count) { return ShareOf(count) >= least; });
  return summed;
}

}  // namespace orbweave
