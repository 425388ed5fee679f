// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "core/io/page/job_report.h"

namespace orbweave {

/// A report of `num_images` panoramas on a loop round a subproblem in `num_clusters` clusters, with
/// overlap, a loose image, one that is uncertain, GNSS outliers, images left out and warnings.
inline JobReport MadeUpReport(uint32_t num_images, uint32_t num_clusters) {
  Random random(7);
  JobReport report;
  report.version = "0.1.0";
  report.title = "Harbour street, <second> drive & return";
  report.images_total = num_images + 3;
  report.registered = num_images;
  report.not_registered = {
      {"IMG_0007 <script>.jpg", "it is 640x480, not 2:1: no full equirectangular panorama"},
      {"IMG_0031.jpg", "it is byte for byte a copy of IMG_0030.jpg"},
      {"IMG_0090.jpg", "truncated: the data end after 81920 bytes, before the image does"}};
  report.models = 1;
  report.each_model = {{.images = num_images,
                        .points = 38412,
                        .observations = 182734,
                        .residual_px_mean = 0.712,
                        .step_median = 5.2,
                        .path_length = 5.2 * num_images}};
  report.checks = {
      {"images_registered",
       1.0,
       0.95,
       "share",
       CheckLevel::kGood,
       "all are registered",
       CheckBound::kAtLeast},
      {"gnss_clock", 0.83, 0.2, "s", CheckLevel::kDoubtful, "the GNSS clock is <late> by 0.8 s"},
      {"look_alikes", 5.0, 0.0, "count", CheckLevel::kGood, "5 pairs look alike"}};
  report.verdict = {CheckLevel::kDoubtful, {"the GNSS clock is <late> by 0.8 s"}};
  report.points = 38412;
  report.observations = 182734;
  report.mean_track_length = 4.757;
  report.residual_px_mean = 0.712;
  report.residual_px_rms = 0.913;
  report.residual_erp_px_mean = 0.847;
  report.residual_histogram.counts.resize(41);
  for (size_t i = 0; i < 41; ++i) {
    const double px = (static_cast<double>(i) + 0.5) * 0.1;
    report.residual_histogram.counts[i] =
        static_cast<uint64_t>(26000.0 * px / 0.55 * std::exp(0.5 - px * px / 0.6));
  }
  report.residual_histogram.counts[40] = 420;
  report.track_lengths.resize(21);
  for (size_t n = 2; n < 21; ++n)
    report.track_lengths[n] =
        static_cast<uint64_t>(14000.0 * std::exp(-0.38 * (static_cast<double>(n) - 2.0)));
  report.gnss = {.used = true,
                 .num_priors = num_images,
                 .num_inliers = num_images - 2,
                 .residual_median_m = 0.84,
                 .residual_rms_inliers_m = 1.02,
                 .outliers = {"IMG_0020.jpg", "IMG_0060.jpg"}};
  report.each_model.front().gnss = report.gnss;
  report.origin = GeodeticPosition{47.61019, -122.32385, 60.0};
  for (uint32_t c = 0; c < num_clusters; ++c)
    report.clusters.push_back({num_images / num_clusters + 8,
                               num_images / num_clusters,
                               num_images / num_clusters + 8,
                               1,
                               9000 + 137 * c,
                               0.88 + 0.01 * c});
  for (uint32_t c = 0; c < num_clusters; ++c) {
    const uint32_t a = std::min(c, (c + 1) % num_clusters);
    const uint32_t b = std::max(c, (c + 1) % num_clusters);
    if (a != b)
      report.seams.push_back({.cluster_a = a,
                              .cluster_b = b,
                              .common_images = 8,
                              .common_tracks = 640 + 11 * c,
                              .inlier_tracks = 611 + 9 * c,
                              .condition_number = 18.4 + c,
                              .position_jump_m = 0.013,
                              .rotation_jump_deg = 0.008,
                              .used = c != 1,
                              .reason = c == 1 ? "3 tracks only <agree>" : ""});
  }
  report.stages = {{"extract_features", 131.2, 251.9, num_images, 0, 0},
                   {"select_pairs", 0.2, 0.2, 1, 0, 0},
                   {"match_pairs", 48.7, 92.4, 26, 0, 1},
                   {"build_view_graph", 0.6, 0.6, 1, 0, 0},
                   {"partition", 0.1, 0.1, 1, 0, 0},
                   {"reconstruct_cluster", 33.4, 61.8, num_clusters - 1, 1, 0},
                   {"merge", 2.1, 2.0, 1, 0, 0},
                   {"adjust_globally", 11.9, 11.7, 1, 0, 0}};
  report.adjustments = {{.phases = {{7, true, {180250.5, 91400.25, 91399.5}}, {4, false, {}}},
                         .bytes_of_subproblem = {51200, 64000}}};
  report.workers = {{"worker-1", 1, 61}, {"worker-2", 1, 58}};
  report.elapsed_s = 231.4;
  report.warnings = {
      "gnss.csv line 17 (IMG_0016.jpg) is not used: its position is 0/0, as receivers write "
      "without a fix",
      "2 rows of gnss.csv have no image: IMG_0200.jpg, IMG_0201.jpg"};
  report.options_text = "features.max_features=8192\nmatching.ratio=0.8\n";
  for (uint32_t i = 0; i < num_images; ++i) {
    ReportImage image;
    image.name = "IMG_" + std::string(4 - std::min<size_t>(4, std::to_string(i).size()), '0') +
                 std::to_string(i) + ".jpg";
    image.registered = true;
    const double share = static_cast<double>(i) / num_images;
    const double angle = 2.0 * std::numbers::pi * share;
    const auto side = [](double value, double half) {
      return half * std::tanh(1.9 * value) / std::tanh(1.9);
    };
    image.centre_in_world = {side(std::cos(angle), 120.0) + 0.5 * random.Normal(),
                             side(std::sin(angle), 62.0) + 0.5 * random.Normal(),
                             0.2 * random.Normal()};
    const double place = share * num_clusters;
    image.cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), image.centre_in_world);
    image.cluster = static_cast<int>(place);
    const double to_border = std::abs(place - std::round(place)) * num_images / num_clusters;
    image.in_overlap = to_border < 4.0;
    image.loose = i == num_images / 2;
    image.gnss_outlier = i == 20 || i == 60;
    image.gnss_in_world =
        image.centre_in_world + Eigen::Vector3d(image.gnss_outlier ? 22.0 : random.Normal(),
                                                image.gnss_outlier ? 14.0 : random.Normal(),
                                                0.0);
    image.observations =
        static_cast<uint32_t>(1500.0 + 500.0 * std::sin(9.0 * angle) + 120.0 * random.Normal());
    image.residual_px_mean = 0.7 + 0.05 * random.Normal();
    image.uncertainty = PoseUncertainty{.rotation_sigma_rad = 1e-4};
    image.uncertainty->position_covariance.diagonal() = Eigen::Vector3d(4e-4, 1e-4, 9e-4);
    if (i == 3) image.uncertainty->position_covariance *= 1e4;
    if (i == 5) image.uncertainty.reset();
    report.images.push_back(image);
  }
  ReportPath path;
  for (uint32_t i = 0; i < num_images; ++i) {
    if (!report.images[i].loose) path.images.push_back(i);
  }
  if (path.images.size() > 1) report.paths = {path};
  report.uncertainty = {.known = num_images > 3,
                        .reason = num_images > 3 ? "" : "too few <images>",
                        .position_median = 0.037,
                        .position_p95 = 0.04,
                        .rotation_median_deg = 0.0057,
                        .rotation_p95_deg = 0.006};
  if (num_images > 3) report.uncertainty.worst = {3, 0};
  report.each_model.front().uncertainty = report.uncertainty;
  return report;
}

}  // namespace orbweave
