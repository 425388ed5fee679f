// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_headings.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kSigmas = 3.0;
constexpr double kModelSigma_deg = 1.0;  // of what a right model's own headings are off
constexpr size_t kFewest = 10;
constexpr double kClearlyBetter = 0.5;

/// The headings of one drive, degrees clockwise from north.
struct HeadingSeries {
  ImageId first{};
  std::vector<double> stated{};
  std::vector<double> seen{};  ///< in the model
  std::vector<double> sigmas{};
};

/// Angles about their middle.
struct Spread {
  double middle_deg = 0.0;
  double off_deg = 0.0;  ///< from the middle, in the median
};

/// How stated headings, times `sign`, differ from the model's.
Spread SpreadOf(const HeadingSeries& series, double sign) {
  double east = 0.0;
  double north = 0.0;
  std::vector<double> differences;
  for (size_t i = 0; i < series.stated.size(); ++i) {
    differences.push_back(sign * series.stated[i] - series.seen[i]);
    east += std::sin(differences.back() / kDegPerRad);
    north += std::cos(differences.back() / kDegPerRad);
  }
  const double mean = kDegPerRad * std::atan2(east, north);
  for (double& difference : differences) difference = std::remainder(difference - mean, 360.0);
  const double median = Quantile(differences, 0.5);
  for (double& difference : differences) difference = std::abs(difference - median);
  return {std::remainder(mean + median, 360.0), Quantile(std::move(differences), 0.5)};
}

std::map<uint32_t, HeadingSeries> SeriesOfDrives(const std::map<ImageId, RegisteredImage>& images,
                                                 const ImageManifest& manifest) {
  std::map<uint32_t, HeadingSeries> drives;
  for (const auto& [id, image] : images) {
    const ImageRecord& record = manifest.At(id);
    if (image.loose || !record.prior.heading_deg) continue;
    HeadingSeries& series = drives[record.drive];
    if (series.stated.empty()) series.first = id;
    const Eigen::Vector3d forward =
        image.cam_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    series.stated.push_back(*record.prior.heading_deg);
    series.seen.push_back(kDegPerRad * std::atan2(forward.x(), forward.y()));
    series.sigmas.push_back(record.prior.heading_sigma_deg);
  }
  std::erase_if(drives, [](const auto& drive) { return drive.second.stated.size() < kFewest; });
  return drives;
}

CrossCheck JudgeHeadings(const HeadingSeries& series,
                         const ImageManifest& manifest,
                         bool is_georeferenced) {
  CrossCheck check{.name = "stated_heading", .unit = "deg"};
  check.limit = kSigmas * std::hypot(Quantile(series.sigmas, 0.5), kModelSigma_deg);
  const Spread spread = SpreadOf(series, 1.0);
  check.value = spread.off_deg;
  const std::string whose = absl::StrCat("headings of ",
                                         series.stated.size(),
                                         " panoramas, the drive of ",
                                         manifest.At(series.first).name);
  if (!check.IsWithinLimit()) {
    check.level = CheckLevel::kDoubtful;
    const bool fits_turned = SpreadOf(series, -1.0).off_deg < kClearlyBetter * spread.off_deg;
    check.sentence = absl::StrFormat(
        "%s, are off by %.1f deg in the median, %.1f deg apart from their mean being what their "
        "accuracies allow: %s",
        whose,
        spread.off_deg,
        check.limit,
        fits_turned ? "they fit counter-clockwise, and clockwise from north is positive"
                    : "they are wrong, or the model is folded; compare them with the pictures");
    return check;
  }
  check.sentence = absl::StrFormat("%s, agree with the model to %.1f deg", whose, spread.off_deg);
  if (is_georeferenced && std::abs(spread.middle_deg) > check.limit) {
    absl::StrAppendFormat(
        &check.sentence,
        " but for %.1f deg that all of them are off: they are not those of the image centre, or "
        "count from another north; the model stands as GNSS has it",
        spread.middle_deg);
  }
  return check;
}

}  // namespace

std::optional<CrossCheck> CheckHeadings(const std::map<ImageId, RegisteredImage>& images,
                                        const ImageManifest& manifest,
                                        bool is_georeferenced) {
  std::optional<CrossCheck> worst;
  for (const auto& [drive, series] : SeriesOfDrives(images, manifest)) {
    CrossCheck check = JudgeHeadings(series, manifest, is_georeferenced);
    if (!worst || check.value * worst->limit > worst->value * check.limit) worst = std::move(check);
  }
  return worst;
}

}  // namespace orbweave
