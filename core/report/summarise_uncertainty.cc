// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/summarise_uncertainty.h"

#include <algorithm>
#include <utility>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr size_t kMaxWorst = 10;

}  // namespace

ReportUncertainty SummariseUncertainty(const UncertaintyReport& report,
                                       const std::map<ImageId, RegisteredImage>& images,
                                       bool heights_are_known) {
  ReportUncertainty result{.known = report.known,
                           .reason = report.reason,
                           .held_image = report.held_image,
                           .held_distance_to = report.held_distance_to,
                           .bearing_sigma_factor = report.bearing_sigma_factor,
                           .horizontal_gnss_sigma_factor = report.horizontal_gnss_sigma_factor,
                           .vertical_gnss_sigma_factor = report.vertical_gnss_sigma_factor,
                           .heights_are_known = heights_are_known};
  std::vector<double> positions;
  std::vector<double> rotations_deg;
  std::vector<std::pair<double, uint32_t>> by_sigma;
  for (const auto& [id, image] : images) {
    if (!image.uncertainty) continue;
    positions.push_back(result.PositionSigma(*image.uncertainty));
    rotations_deg.push_back(image.uncertainty->RotationSigma_deg());
    by_sigma.emplace_back(-positions.back(), id.value);
  }
  result.position_median = Quantile(positions, 0.5);
  result.position_p95 = Quantile(positions, 0.95);
  result.rotation_median_deg = Quantile(rotations_deg, 0.5);
  result.rotation_p95_deg = Quantile(rotations_deg, 0.95);
  std::sort(by_sigma.begin(), by_sigma.end());
  if (by_sigma.size() > kMaxWorst) by_sigma.resize(kMaxWorst);
  for (const auto& [negative_sigma, index] : by_sigma) result.worst.push_back(index);
  return result;
}

}  // namespace orbweave
