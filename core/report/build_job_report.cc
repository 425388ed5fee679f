// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/build_job_report.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "absl/strings/str_format.h"
#include "core/report/borne_out_by_gnss.h"
#include "core/report/check_contradicted_pairs.h"
#include "core/report/check_hinges.h"
#include "core/report/check_job.h"
#include "core/report/check_lengths.h"
#include "core/report/check_look_alikes.h"
#include "core/report/check_pairs.h"
#include "core/report/check_standing_camera.h"
#include "core/report/check_stretches.h"
#include "core/report/check_told_steps.h"
#include "core/report/judge_model.h"
#include "core/report/list_missing_images.h"
#include "core/report/list_unchecked.h"
#include "core/report/summarise_uncertainty.h"
#include "core/report/tell_carriers.h"
#include "core/report/trace_paths.h"

namespace orbweave {
namespace {

/// Image rows as far as the partition knows them.
std::vector<ReportImage> StartRows(const JobResults& results) {
  std::vector<ReportImage> rows(results.manifest.images.size());
  std::vector<int> times_used(rows.size(), 0);
  for (const ImageRecord& image : results.manifest.images) {
    rows[image.id.value].name = image.name;
    rows[image.id.value].drive = image.drive;
  }
  const std::vector<Cluster>& clusters = results.view_graph.partition.clusters;
  for (size_t c = 0; c < clusters.size(); ++c) {
    for (const ImageId id : clusters[c].interior) rows[id.value].cluster = static_cast<int>(c);
    for (const ImageId id : clusters[c].images)
      rows[id.value].in_overlap = ++times_used[id.value] > 1;
  }
  return rows;
}

void FillModel(const JobResults& results, uint32_t number, JobReport& report) {
  const AdjustedModel& model = results.models[number];
  const std::set<std::string> outliers(model.report.gnss.outliers.begin(),
                                       model.report.gnss.outliers.end());
  for (const auto& [id, image] : model.images) {
    ReportImage& row = report.images[id.value];
    // Rather where it is observed, then in the larger model.
    if (row.registered && (image.loose || !row.loose)) continue;
    const ImageRecord& record = results.manifest.At(id);
    row.registered = true;
    row.loose = image.loose;
    row.model = number;
    row.uncertainty = image.uncertainty;
    row.cam_from_world = image.cam_from_world;
    row.centre_in_world = image.cam_from_world.Centre();
    row.gnss_in_world.reset();
    if (model.report.gnss.used) row.gnss_in_world = record.prior.position_in_enu;
    row.gnss_outlier = !image.loose && outliers.contains(record.name);
    row.observations = 0;
    row.residual_px_mean = 0.0;
    if (const auto found = model.measures.images.find(id); found != model.measures.images.end()) {
      row.observations = found->second.observations;
      row.residual_px_mean = found->second.residual_px_mean;
    }
  }
}

void AddCounts(const std::vector<uint64_t>& more, std::vector<uint64_t>& counts) {
  if (counts.size() < more.size()) counts.resize(more.size());
  for (size_t i = 0; i < more.size(); ++i) counts[i] += more[i];
}

/// Sums over worlds; means are weighted by observations.
void AddMeasures(const ReconstructionMeasures& measures, JobReport& report) {
  const double before = static_cast<double>(report.observations);
  const double added = static_cast<double>(measures.observations);
  const double total = before + added;
  if (total > 0.0) {
    report.residual_px_mean =
        (report.residual_px_mean * before + measures.residual_px_mean * added) / total;
    report.residual_erp_px_mean =
        (report.residual_erp_px_mean * before + measures.residual_erp_px_mean * added) / total;
    report.residual_px_rms =
        std::sqrt((report.residual_px_rms * report.residual_px_rms * before +
                   measures.residual_px_rms * measures.residual_px_rms * added) /
                  total);
  }
  report.points += measures.points;
  report.observations += measures.observations;
  report.residual_histogram.bin_width = measures.residual_histogram.bin_width;
  AddCounts(measures.residual_histogram.counts, report.residual_histogram.counts);
  AddCounts(measures.track_lengths, report.track_lengths);
}

void TellReviews(const PartitionReview& review, JobReport& report) {
  for (const OverlapRequest& request : review.requests) {
    report.warnings.push_back("clusters " + std::to_string(request.cluster_a) + " and " +
                              std::to_string(request.cluster_b) +
                              " were reconstructed again with up to " +
                              std::to_string(request.images) + " shared images: " + request.reason);
  }
}

/// Cuts that were made where pairs leave little hope for the seam.
void TellWeakCuts(const Partition& partition, JobReport& report) {
  for (const Seam& seam : partition.seams) {
    if (seam.weakness.empty()) continue;
    report.warnings.push_back("clusters " + std::to_string(seam.cluster_a) + " and " +
                              std::to_string(seam.cluster_b) +
                              " are divided where the seam may not hold: " + seam.weakness);
  }
}

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

/// Seams speak of submodels; the report names their clusters.
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

/// On the map, images without a pose are where GNSS says.
void PlaceMissingByGnss(const ImageManifest& manifest, JobReport& report) {
  const bool on_earth = std::ranges::any_of(
      report.each_model, [](const ReportModel& model) { return model.gnss.used; });
  if (!on_earth) return;
  report.origin = manifest.origin;
  for (const ImageRecord& record : manifest.images) {
    ReportImage& row = report.images[record.id.value];
    if (!row.registered) row.gnss_in_world = record.prior.position_in_enu;
  }
}

/// The checks that a model was adjusted with. Which model it is is said where there are several,
/// and one that holds less than one registered image in twenty does not make the job bad: as many
/// may be missing from a good one.
std::vector<CrossCheck> ChecksOfModel(const JobResults& results,
                                      const JobReport& report,
                                      size_t number) {
  std::vector<CrossCheck> checks = results.models[number].report.checks;
  const bool is_small = 20 * report.each_model[number].images < report.registered;
  for (CrossCheck& check : checks) {
    if (is_small) check.level = std::min(check.level, CheckLevel::kDoubtful);
    if (results.models.size() > 1 && !check.sentence.starts_with("model "))
      check.sentence = "model " + std::to_string(number) + ": " + check.sentence;
  }
  return checks;
}

void Judge(const JobResults& results, const BorneOutByGnss& gnss, JobReport& report) {
  for (size_t number = 0; number < results.models.size(); ++number)
    std::ranges::copy(ChecksOfModel(results, report, number), std::back_inserter(report.checks));
  const bool has_pairs = std::ranges::any_of(
      report.checks, [](const CrossCheck& check) { return check.name == "pairs_contradicted"; });
  if (const auto pairs = CheckContradictedPairs(results, gnss); pairs && !has_pairs)
    report.checks.push_back(*pairs);
  std::ranges::copy(CheckJob(results, report), std::back_inserter(report.checks));
  report.verdict = JudgeModel(report);
  report.verdict.unchecked = ListUnchecked(results, report);
}

}  // namespace

ClusterSummary SummariseCluster(const ClusterResult& result) {
  const ClusterReconstruction& cluster = result.reconstruction;
  ClusterSummary summary{.cluster = result.cluster,
                         .not_registered = cluster.not_registered,
                         .contradicted_pairs = cluster.contradicted_pairs,
                         .explained_pairs = cluster.explained_pairs,
                         .pair_lengths = cluster.pair_lengths,
                         .gap_lengths = cluster.gap_lengths,
                         .residual_rms_px = cluster.residual_rms_px};
  for (const Reconstruction& submodel : cluster.submodels) {
    summary.submodels.push_back(
        {static_cast<uint32_t>(submodel.images.size()), submodel.tracks.size()});
  }
  return summary;
}

JobReport BuildJobReport(const JobResults& results) {
  JobReport report;
  report.images = StartRows(results);
  report.images_total =
      static_cast<uint32_t>(results.manifest.images.size() + results.manifest.excluded.size());
  report.models = static_cast<uint32_t>(results.models.size());
  for (uint32_t model = 0; model < report.models; ++model) {
    AddMeasures(results.models[model].measures, report);
    FillModel(results, model, report);
    report.adjustments.push_back(AdjustmentRow(results.models[model].report));
  }
  if (report.points > 0) {
    report.mean_track_length =
        static_cast<double>(report.observations) / static_cast<double>(report.points);
  }
  report.registered = static_cast<uint32_t>(std::ranges::count_if(
      report.images, [](const ReportImage& row) { return row.registered && !row.loose; }));
  report.clusters = ClusterRows(results);
  report.seams = SeamRows(results);
  for (const uint8_t rung : results.view_graph.edge_rungs) ++report.pairs_of_rung.at(rung);
  if (results.wider_pairs) report.wider_pairs = WiderPairsRow(*results.wider_pairs);
  report.warnings = results.manifest.warnings;
  ListMissingImages(results, report);
  TellReviews(results.review, report);
  TellWeakCuts(results.view_graph.partition, report);
  TellCarriers(results, report);
  const BorneOutByGnss gnss(results);
  report.checks.push_back(CheckPairs(results, gnss));
  report.checks.push_back(CheckLengths(results));
  report.checks.push_back(CheckToldSteps(results));
  report.checks.push_back(CheckHinges(results));
  report.checks.push_back(CheckStretches(results));
  if (std::optional<CrossCheck> standing = CheckStandingCamera(results, report.images))
    report.checks.push_back(*std::move(standing));
  report.checks.push_back(CheckLookAlikes(results));
  report.each_model = ModelRows(results, report);
  if (!report.each_model.empty()) {
    report.gnss = report.each_model.front().gnss;
    report.uncertainty = report.each_model.front().uncertainty;
  }
  TracePaths(results.manifest, report);
  PlaceMissingByGnss(results.manifest, report);
  Judge(results, gnss, report);
  return report;
}

}  // namespace orbweave
