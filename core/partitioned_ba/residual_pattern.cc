// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/residual_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <string>

namespace orbweave {
namespace {

constexpr double kSignificant = 6.0;    // standard deviations of a mean
constexpr double kNoticeable_px = 0.1;  // a fifth of what a good feature scatters by itself
// The mean of n residuals scatters by their noise over sqrt(n). A pattern of half the noise is more
// than the mean of four observations leaves open: from then on more of them no longer make a pose
// better, while its sigma, which knows nothing of patterns, goes on shrinking.
constexpr double kShareOfNoise = 0.5;

size_t BinOf(double share, size_t bins) {
  const auto bin = static_cast<size_t>(std::max(share, 0.0) * static_cast<double>(bins));
  return std::min(bins - 1, bin);
}

double Largest(std::span<const double> sums_px, std::span<const uint32_t> counts, double rms_px) {
  double largest = 0.0;
  for (size_t i = 0; i < sums_px.size(); ++i) {
    if (counts[i] == 0) continue;
    const double mean_px = std::abs(sums_px[i]) / counts[i];
    if (mean_px * std::sqrt(counts[i]) > kSignificant * rms_px)
      largest = std::max(largest, mean_px);
  }
  return largest;
}

std::string SentenceOf(double over_azimuth_px, double over_latitude_px) {
  const bool is_latitude = over_latitude_px > over_azimuth_px;
  char text[400];
  std::snprintf(text,
                sizeof text,
                "residuals of up to %.2f px repeat at the same %s of every panorama: %s; the model "
                "may be bent or stretched by more than its sigmas say",
                std::max(over_azimuth_px, over_latitude_px),
                is_latitude ? "latitude" : "azimuth",
                is_latitude ? "a panorama whose height does not fit its width, or another "
                              "projection than equirectangular"
                            : "stitched lenses that do not share a centre, or another projection");
  return text;
}

}  // namespace

void ResidualPattern::Add(const Eigen::Vector3d& bearing,
                          const Eigen::Vector3d& ray,
                          double px_per_rad) {
  const double azimuth = std::atan2(bearing.x(), bearing.z());
  const double latitude = std::asin(std::clamp(-bearing.y(), -1.0, 1.0));
  const size_t sector = BinOf(azimuth / (2.0 * std::numbers::pi) + 0.5, kSectors);
  const size_t band = BinOf(latitude / std::numbers::pi + 0.5, kBands);
  const Eigen::Vector3d sideways(std::cos(azimuth), 0.0, -std::sin(azimuth));
  const Eigen::Vector3d up(-std::sin(latitude) * std::sin(azimuth),
                           -std::cos(latitude),
                           -std::sin(latitude) * std::cos(azimuth));
  const Eigen::Vector3d error_px = px_per_rad * (bearing - ray);
  sum_px[sector] += sideways.dot(error_px);
  sum_up_px[sector] += up.dot(error_px);
  ++count[sector];
  band_up_px[band] += up.dot(error_px);
  ++band_count[band];
}

void ResidualPattern::Add(const ResidualPattern& other) {
  for (size_t s = 0; s < kSectors; ++s) {
    sum_px[s] += other.sum_px[s];
    sum_up_px[s] += other.sum_up_px[s];
    count[s] += other.count[s];
  }
  for (size_t b = 0; b < kBands; ++b) {
    band_up_px[b] += other.band_up_px[b];
    band_count[b] += other.band_count[b];
  }
}

double ResidualPattern::LargestOverAzimuthPx(double rms_px) const {
  return std::max(Largest(sum_px, count, rms_px), Largest(sum_up_px, count, rms_px));
}

double ResidualPattern::LargestOverLatitudePx(double rms_px) const {
  return Largest(band_up_px, band_count, rms_px);
}

double ResidualPattern::LargestPx(double rms_px) const {
  return std::max(LargestOverAzimuthPx(rms_px), LargestOverLatitudePx(rms_px));
}

CrossCheck CheckResidualPattern(const ResidualPattern& pattern, double rms_px) {
  const double over_azimuth_px = pattern.LargestOverAzimuthPx(rms_px);
  const double over_latitude_px = pattern.LargestOverLatitudePx(rms_px);
  CrossCheck check{.name = "residual_pattern",
                   .value = std::max(over_azimuth_px, over_latitude_px),
                   .limit = std::max(kNoticeable_px, kShareOfNoise * rms_px),
                   .unit = "px"};
  check.sentence = "no residual repeats at the same place of every panorama";
  if (!check.IsWithinLimit()) {
    check.level = CheckLevel::kDoubtful;
    check.sentence = SentenceOf(over_azimuth_px, over_latitude_px);
  } else if (check.value >= kNoticeable_px) {
    check.sentence = "what repeats at the same place of every panorama is small beside the noise";
  }
  return check;
}

}  // namespace orbweave
