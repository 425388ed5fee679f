// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/report_rows.h"

#include <algorithm>

#include "core/report/summarise_uncertainty.h"

namespace orbweave {
namespace {

ReportSeamFit FitAfter(const JobResults& results, const ReportSeam& seam) {
  for (const SeamCertificate& certificate : results.certificates) {
    if (certificate.cluster_a != seam.cluster_a || certificate.cluster_b != seam.cluster_b)
      continue;
    return {.images = certificate.num_images,
            .position_jump_m = certificate.position_jump_m,
            .rotation_jump_deg = certificate.rotation_jump_deg,
            .position_noise_m = certificate.position_noise_m,
            .rotation_noise_deg = certificate.rotation_noise_deg};
  }
  return {};
}

ReportGnss GnssRow(const GnssReport& gnss) {
  return {.used = gnss.used,
          .reason = gnss.reason,
          .num_priors = gnss.num_priors,
          .num_inliers = gnss.num_inliers,
          .residual_median_m = gnss.residual_median_m,
          .residual_rms_inliers_m = gnss.residual_rms_inliers_m,
          .deformation_m = gnss.deformation_m,
          .outliers = gnss.outliers};
}

/// Those of a model in a frame of its own are as good as its other coordinates.
bool HeightsAreKnown(const AdjustedModel& model, const ImageManifest& manifest) {
  return !model.report.gnss.used || std::ranges::any_of(model.images, [&](const auto& image) {
    const PosePrior& prior = manifest.At(image.first).prior;
    return prior.position_in_enu && IsHeightKnown(prior.vertical_sigma_m);
  });
}

}  // namespace

std::vector<ReportCluster> ClusterRows(const JobResults& results) {
  std::vector<ReportCluster> rows(results.view_graph.partition.clusters.size());
  for (size_t c = 0; c < rows.size(); ++c) {
    rows[c].images = static_cast<uint32_t>(results.view_graph.partition.clusters[c].images.size());
    rows[c].interior =
        static_cast<uint32_t>(results.view_graph.partition.clusters[c].interior.size());
  }
  for (const ClusterSummary& cluster : results.clusters) {
    ReportCluster& row = rows[cluster.cluster];
    row.submodels = static_cast<uint32_t>(cluster.submodels.size());
    row.residual_px_rms = cluster.residual_rms_px;
    for (const ClusterSummary::Submodel& submodel : cluster.submodels) {
      row.registered += submodel.images;
      row.points += submodel.points;
    }
  }
  return rows;
}

std::vector<ReportSeam> SeamRows(const JobResults& results) {
  std::vector<uint32_t> cluster_of_submodel;
  for (const ClusterSummary& cluster : results.clusters) {
    cluster_of_submodel.insert(
        cluster_of_submodel.end(), cluster.submodels.size(), cluster.cluster);
  }
  std::vector<ReportSeam> rows;
  for (const SeamReport& seam : results.alignment.seams) {
    rows.push_back({.cluster_a = cluster_of_submodel[seam.submodel_a],
                    .cluster_b = cluster_of_submodel[seam.submodel_b],
                    .common_images = seam.common_images,
                    .common_tracks = seam.common_tracks,
                    .inlier_tracks = seam.inlier_tracks,
                    .condition_number = seam.condition_number,
                    .position_jump_m = seam.position_jump_m,
                    .rotation_jump_deg = seam.rotation_jump_deg,
                    .used = seam.used,
                    .contradicted = seam.contradicted,
                    .drift_factor = seam.drift_factor,
                    .reason = seam.reason});
    if (seam.used) rows.back().after = FitAfter(results, rows.back());
  }
  return rows;
}

ReportWiderPairs WiderPairsRow(const WiderPairs& wider) {
  return {.facades = wider.wants_facades,
          .second = wider.second.size(),
          .held_back = wider.num_held_back,
          .reserve = wider.reserve.size(),
          .predicted = wider.predicted.size(),
          .thin_images = wider.num_thin_images};
}

ReportAdjustment AdjustmentRow(const GlobalAdjustReport& report) {
  ReportAdjustment row{.bytes_of_subproblem = report.bytes_of_subproblem};
  for (size_t i = 0; i < report.adjustments.size(); ++i) {
    ReportPhase& phase = row.phases.emplace_back();
    phase.steps = report.adjustments[i].iterations;
    phase.converged = report.adjustments[i].converged;
    if (i < report.accepted_costs.size()) phase.accepted_costs = report.accepted_costs[i];
  }
  return row;
}

std::vector<ReportModel> ModelRows(const JobResults& results, const JobReport& report) {
  std::vector<ReportModel> rows;
  for (uint32_t number = 0; number < results.models.size(); ++number) {
    const AdjustedModel& model = results.models[number];
    ReportModel& row = rows.emplace_back();
    row.points = model.measures.points;
    row.observations = model.measures.observations;
    row.residual_px_mean = model.measures.residual_px_mean;
    row.uncertainty = SummariseUncertainty(
        model.report.uncertainty, model.images, HeightsAreKnown(model, results.manifest));
    row.gnss = GnssRow(model.report.gnss);
  }
  for (const ReportImage& image : report.images) {
    if (image.registered) ++(image.loose ? rows[image.model].loose : rows[image.model].images);
  }
  return rows;
}

}  // namespace orbweave
