// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_leans.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/quantile.h"
#include "core/estimators/mean_direction.h"
#include "core/geometry/rotation.h"
#include "core/merging/georeference/drive_attitudes.h"
#include "core/merging/georeference/estimate_gravity.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kLeastLean_deg = 10.0;
constexpr double kOfMedian = 5.0;
constexpr double kHeldByHand_deg = 5.0;
constexpr double kLossScale_deg = 2.0;

struct Lean {
  ImageId image{};
  double deg = 0.0;
};

std::vector<Lean> LeansOf(const Reconstruction& model,
                          const ImageManifest& manifest,
                          const Vector3d& down_in_world) {
  std::vector<Lean> leans;
  for (const DriveAttitudes& drive : AttitudesOfDrives(model, manifest)) {
    std::vector<Vector3d> downs;
    for (const Eigen::Matrix3d& R : drive.level_from_world) downs.emplace_back(R * down_in_world);
    const Vector3d mean = RobustMeanDirection(downs, Vector3d::UnitY(), kLossScale_deg);
    for (size_t i = 0; i < downs.size(); ++i)
      leans.push_back({drive.images[i], kDegPerRad * AngleBetween(downs[i], mean)});
  }
  return leans;
}

}  // namespace

CrossCheck CheckLeans(const std::map<ImageId, RegisteredImage>& images,
                      const ImageManifest& manifest) {
  CrossCheck check{.name = "camera_leans", .unit = "deg"};
  check.sentence = "panoramas are not upright: how they lean tells nothing of the model";
  const Reconstruction model{.images = images};
  const std::optional<Gravity> gravity = EstimateGravity(model, manifest);
  if (!gravity) return check;
  const std::vector<Lean> leans = LeansOf(model, manifest, gravity->down_in_world);
  if (leans.empty()) return check;
  std::vector<double> degrees;
  for (const Lean& lean : leans) degrees.push_back(lean.deg);
  const double median_deg = Quantile(degrees, 0.5);
  if (median_deg > kHeldByHand_deg) return check;
  const Lean& worst = *std::ranges::max_element(leans, {}, &Lean::deg);
  check.value = worst.deg;
  check.limit = std::max(kLeastLean_deg, kOfMedian * median_deg);
  if (worst.deg <= check.limit) {
    check.sentence = absl::StrFormat(
        "panoramas lean by %.1f deg in the median, none by more than %.1f", median_deg, worst.deg);
    return check;
  }
  check.level = CheckLevel::kDoubtful;
  const auto off =
      std::ranges::count_if(leans, [&](const Lean& lean) { return lean.deg > check.limit; });
  check.sentence = absl::StrFormat(
      "%d of %d panoramas lean by more than %.0f deg where most lean by less than %.1f, most of "
      "all %s, by %.0f: the model climbs or lies askew there, unless the street is as steep or the "
      "camera was held otherwise; heights and attitudes about there are not to be trusted; "
      "positions with exact heights, and their accuracy, hold it",
      off,
      leans.size(),
      check.limit,
      median_deg,
      manifest.At(worst.image).name,
      worst.deg);
  return check;
}

}  // namespace orbweave
