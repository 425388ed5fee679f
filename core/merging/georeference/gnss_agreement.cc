// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/gnss_agreement.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/merging/georeference/cluster_spreads.h"
#include "core/robust/false_alarms.h"

namespace orbweave {
namespace {

constexpr double kMaxScaleUncertainty = 0.1;
// No two similarities have a majority; that it is one by chance is asked as of pairs of images.
constexpr double kMinAgreeingShare = 0.5;
constexpr double kMaxLog10FalseAlarms = -4.0;
constexpr size_t kMinDrive = 8;
constexpr double kSigmaOfMad = 1.4826;

// Model minus GNSS, without the bias (median) of each drive that is long enough to have one.
std::vector<Eigen::Vector3d> Residuals(const GnssPositions& positions, const Sim3& enu_from_world) {
  std::vector<Eigen::Vector3d> residuals;
  std::map<uint32_t, std::vector<size_t>> members;
  for (size_t i = 0; i < positions.size(); ++i) {
    residuals.push_back(enu_from_world * positions.in_world[i] - positions.in_enu[i]);
    members[positions.drive[i]].push_back(i);
  }
  for (const auto& [drive, indices] : members) {
    if (members.size() == 1 || indices.size() < kMinDrive) continue;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const size_t i : indices) values.push_back(residuals[i][axis]);
      const double bias = Quantile(std::move(values), 0.5);
      for (const size_t i : indices) residuals[i][axis] -= bias;
    }
  }
  return residuals;
}

void MeasureScatter(const GnssPositions& positions,
                    const std::vector<Eigen::Vector3d>& residuals,
                    Georeference& result) {
  std::vector<double> horizontal;
  std::vector<double> vertical;
  for (size_t i = 0; i < residuals.size(); ++i) {
    horizontal.push_back(std::abs(residuals[i].x()));
    horizontal.push_back(std::abs(residuals[i].y()));
    if (positions.KnowsHeight(i)) vertical.push_back(std::abs(residuals[i].z()));
  }
  // The fit has taken seven of the 3n degrees of freedom.
  const auto n = static_cast<double>(residuals.size());
  const double sigma_of_median = kSigmaOfMad * std::sqrt(3.0 * n / (3.0 * n - 7.0));
  result.horizontal_scatter_m = sigma_of_median * Quantile(std::move(horizontal), 0.5);
  result.vertical_scatter_m = sigma_of_median * Quantile(std::move(vertical), 0.5);
}

GnssAgreement AgreementOf(const GnssPositions& positions,
                          const std::vector<Eigen::Vector3d>& residuals,
                          double scatter_m) {
  GnssAgreement agreement{.all = residuals.size(),
                          .within_m = 3.0 * std::max(scatter_m, positions.MedianSigma_m())};
  for (size_t i = 0; i < residuals.size(); ++i) {
    const double sigma_m = std::max(scatter_m, positions.sigma_m[i].x());
    agreement.agreeing += residuals[i].head<2>().norm() <= 3.0 * sigma_m ? 1U : 0U;
  }
  return agreement;
}

}  // namespace

bool GnssAgreement::IsEvident(double extent_m) const {
  return Share() > kMinAgreeingShare &&
         Log10FalseAlarms(all, agreeing, 2, std::min(1.0, within_m / extent_m)) <=
             kMaxLog10FalseAlarms;
}

std::string GnssAgreement::Sentence() const {
  return absl::StrFormat("%.0f %% of the GNSS positions agree with the model", 100.0 * Share());
}

GnssAgreement MeasureAgreement(const GnssPositions& positions, Georeference& result) {
  const std::vector<Eigen::Vector3d> residuals = Residuals(positions, *result.enu_from_world);
  MeasureScatter(positions, residuals, result);
  const double extent_m = result.enu_from_world->scale * SpreadOf(positions.in_world).rms;
  const double scatter_m = result.horizontal_scatter_m;
  result.scale_uncertainty =
      scatter_m / (extent_m * std::sqrt(static_cast<double>(positions.size())));
  const bool carries_scale =
      scatter_m < extent_m && result.scale_uncertainty <= kMaxScaleUncertainty;
  const GnssAgreement agreement = AgreementOf(positions, residuals, scatter_m);
  if (carries_scale && (agreement.IsUsual() || agreement.IsEvident(extent_m))) return agreement;
  result.enu_from_world.reset();
  result.reason = carries_scale ? agreement.Sentence() + ": too few"
                                : absl::StrFormat(
                                      "GNSS scatters by %.1f m about a model that would extend "
                                      "over %.1f m: too much to carry its scale",
                                      scatter_m,
                                      extent_m);
  return agreement;
}

}  // namespace orbweave
