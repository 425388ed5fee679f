// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/judge_gnss.h"

#include <cmath>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

constexpr double kOutlierSigmas = 3.37;  // 99 % of three normal variables

}  // namespace

GnssReport JudgeGnss(const GlobalProblem& problem,
                     const std::vector<Eigen::Vector3d>& biases_m,
                     const ImageManifest& manifest,
                     const std::map<ImageId, RegisteredImage>& images) {
  GnssReport report{.used = true};
  std::vector<double> distances_m;
  double sum_of_squares = 0.0;
  for (const PositionPrior& prior : problem.bundle.position_priors) {
    const ImageId id = problem.image_of_pose[prior.pose];
    const auto image = images.find(id);
    if (image == images.end() || image->second.loose) continue;
    Eigen::Vector3d residual =
        problem.bundle.cams_from_world[prior.pose].Centre() - prior.position_in_world;
    if (prior.bias_group) residual += biases_m[*prior.bias_group];
    if (!prior.is_height_known) residual.z() = 0.0;
    distances_m.push_back(residual.norm());
    ++report.num_priors;
    if (residual.cwiseQuotient(prior.sigma_m).norm() > kOutlierSigmas) {
      report.outliers.push_back(manifest.At(id).name);
      continue;
    }
    ++report.num_inliers;
    sum_of_squares += residual.squaredNorm();
  }
  report.residual_median_m = Quantile(std::move(distances_m), 0.5);
  if (report.num_inliers > 0) {
    report.residual_rms_inliers_m = std::sqrt(sum_of_squares / report.num_inliers);
  }
  return report;
}

}  // namespace orbweave
