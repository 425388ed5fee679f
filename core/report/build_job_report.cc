// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/build_job_report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/report/check_job.h"
#include "core/report/judge_model.h"
#include "core/report/list_missing_images.h"
#include "core/report/list_unchecked.h"
#include "core/report/report_rows.h"
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

}  // namespace

ClusterSummary SummariseCluster(const ClusterResult& result) {
  const ClusterReconstruction& cluster = result.reconstruction;
  ClusterSummary summary{.cluster = result.cluster,
                         .not_registered = cluster.not_registered,
                         .contradicted_pairs = cluster.contradicted_pairs,
                         .explained_pairs = cluster.explained_pairs,
                         .parted_pairs = cluster.parted_pairs,
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
  report.each_model = ModelRows(results, report);
  if (!report.each_model.empty()) {
    report.gnss = report.each_model.front().gnss;
    report.uncertainty = report.each_model.front().uncertainty;
  }
  TracePaths(results.manifest, report);
  PlaceMissingByGnss(results.manifest, report);
  report.checks = CheckJob(results, report);
  report.verdict = JudgeModel(report);
  report.verdict.unchecked = ListUnchecked(results, report);
  return report;
}

}  // namespace orbweave
