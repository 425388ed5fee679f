// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/report_json.h"

#include <utility>

#include "core/io/json_text.h"
#include "core/io/page/group_messages.h"
#include "core/io/page/level_text.h"
#include "core/io/page/report_gnss.h"
#include "core/io/page/report_json_rows.h"
#include "core/io/page/report_seams.h"
#include "core/io/page/report_uncertainty.h"

namespace orbweave {
namespace {

Json NotRegistered(const JobReport& report) {
  Json list = Json::array();
  for (const Exclusion& image : report.not_registered)
    list.push_back({{"name", image.name}, {"reason", image.reason}});
  return list;
}

Json Clusters(const JobReport& report) {
  Json list = Json::array();
  for (const ReportCluster& cluster : report.clusters) {
    list.push_back({{"images", cluster.images},
                    {"interior", cluster.interior},
                    {"registered", cluster.registered},
                    {"components", cluster.submodels},
                    {"points", cluster.points},
                    {"residual_px_rms", cluster.residual_px_rms}});
  }
  return list;
}

Json SeamAfter(const ReportSeamFit& after) {
  if (after.images == 0) return nullptr;
  return {{"images", after.images},
          {"position_jump_m", after.position_jump_m},
          {"rotation_jump_deg", after.rotation_jump_deg},
          {"position_noise_m", after.position_noise_m},
          {"rotation_noise_deg", after.rotation_noise_deg},
          {"times_noise", after.Ratio()}};
}

Json Seams(const JobReport& report) {
  Json list = Json::array();
  for (const ReportSeam& seam : report.seams) {
    list.push_back({{"clusters", {seam.cluster_a, seam.cluster_b}},
                    {"common_images", seam.common_images},
                    {"common_tracks", seam.common_tracks},
                    {"inlier_tracks", seam.inlier_tracks},
                    {"condition_number", seam.condition_number},
                    {"position_jump_m", seam.position_jump_m},
                    {"rotation_jump_deg", seam.rotation_jump_deg},
                    {"after_adjustment", SeamAfter(seam.after)},
                    {"verdict", VerdictText(seam.after.Verdict())},
                    {"used", seam.used},
                    {"contradicted", seam.contradicted},
                    {"drift_factor", seam.drift_factor},
                    {"reason", seam.reason}});
  }
  return list;
}

Json Gnss(const ReportGnss& gnss) {
  return {{"used", gnss.used},
          {"reason", gnss.reason},
          {"priors", gnss.num_priors},
          {"inliers", gnss.num_inliers},
          {"residual_median_m", gnss.residual_median_m},
          {"residual_rms_inliers_m", gnss.residual_rms_inliers_m},
          {"bend_m", gnss.deformation_m},
          {"outliers", gnss.outliers}};
}

/// GNSS minus model of the positions that are contradicted.
Json Contradicted(const JobReport& report) {
  Json list = Json::array();
  for (const ReportImage* image : ContradictedPositions(report)) {
    const Eigen::Vector3d off_m = *image->gnss_in_world - image->centre_in_world;
    list.push_back({{"name", image->name},
                    {"model", image->model},
                    {"east_m", off_m.x()},
                    {"north_m", off_m.y()},
                    {"up_m", off_m.z()},
                    {"distance_m", off_m.norm()}});
  }
  return list;
}

Json Checks(const JobReport& report) {
  Json list = Json::array();
  for (const CrossCheck& check : report.checks) {
    const bool has_limit = check.limit != 0.0;
    list.push_back({{"name", check.name},
                    {"value", check.value},
                    {"limit", has_limit ? Json(check.limit) : Json(nullptr)},
                    {"limit_is", has_limit ? Json(BoundText(check.bound)) : Json(nullptr)},
                    {"unit", check.unit},
                    {"level", LevelText(check.level)},
                    {"sentence", check.sentence}});
  }
  return list;
}

/// null where it is not known.
Json LengthJson(double length) { return length > 0.0 ? Json(length) : Json(nullptr); }

/// Of one model.
Json Uncertainty(const ReportUncertainty& uncertainty,
                 const ReportModel& model,
                 const JobReport& report) {
  Json json = {{"known", uncertainty.known}, {"frame", UncertaintyFrameText(uncertainty)}};
  if (!uncertainty.known) return json;
  json["unit"] = model.gnss.used ? "metre" : "free";
  json["position_sigma_of"] = uncertainty.heights_are_known ? "all axes" : "ground";
  json["position_sigma_median"] = uncertainty.position_median;
  json["position_sigma_p95"] = uncertainty.position_p95;
  json["rotation_sigma_median_deg"] = uncertainty.rotation_median_deg;
  json["rotation_sigma_p95_deg"] = uncertainty.rotation_p95_deg;
  json["bearing_sigma_factor"] = uncertainty.bearing_sigma_factor;
  json["gnss_sigma_factors"] = {{"horizontal", uncertainty.horizontal_gnss_sigma_factor},
                                {"vertical", uncertainty.vertical_gnss_sigma_factor}};
  const auto share = [&](double length) {
    return length > 0.0 ? Json(uncertainty.position_median / length) : Json(nullptr);
  };
  json["relative"] = {{"in_order", model.is_in_order},
                      {"path_length", LengthJson(model.path_length)},
                      {"step_median", LengthJson(model.step_median)},
                      {"position_sigma_median_share_of_path", share(model.path_length)},
                      {"position_sigma_median_share_of_step", share(model.step_median)}};
  json["worst"] = Json::array();
  for (const uint32_t index : uncertainty.worst) {
    const ReportImage& image = report.images[index];
    json["worst"].push_back({{"name", image.name},
                             {"position_sigma", uncertainty.PositionSigma(*image.uncertainty)},
                             {"rotation_sigma_deg", image.uncertainty->RotationSigma_deg()}});
  }
  return json;
}

Json EachModel(const JobReport& report) {
  Json list = Json::array();
  for (const ReportModel& model : report.each_model) {
    list.push_back({{"registered", model.images},
                    {"loose", model.loose},
                    {"points", model.points},
                    {"observations", model.observations},
                    {"residual_px_mean", model.residual_px_mean},
                    {"georeferenced", model.gnss.used},
                    {"gnss", Gnss(model.gnss)},
                    {"uncertainty", Uncertainty(model.uncertainty, model, report)},
                    {"in_order", model.is_in_order},
                    {"step_median", LengthJson(model.step_median)},
                    {"path_length", LengthJson(model.path_length)}});
  }
  return list;
}

Json ImageRow(const ReportImage& image) {
  Json row = {{"name", image.name}, {"state", image.StateText()}, {"drive", image.drive}};
  row["cluster"] = image.cluster < 0 ? Json(nullptr) : Json(image.cluster);
  if (!image.registered) return row;
  row["model"] = image.model;
  row["observations"] = image.observations;
  row["residual_px"] = image.observations > 0 ? Json(image.residual_px_mean) : Json(nullptr);
  row["centre"] = VectorJson(image.centre_in_world);
  if (image.uncertainty) {
    row["sigma"] = VectorJson(image.uncertainty->PositionSigmas());
    row["sigma_rotation_deg"] = image.uncertainty->RotationSigma_deg();
  }
  if (image.gnss_in_world) {
    row["gnss_minus_model_m"] = VectorJson(*image.gnss_in_world - image.centre_in_world);
    row["gnss_contradicted"] = image.gnss_outlier;
  }
  return row;
}

/// A line per image, as the last member of the outermost object of `json`.
std::string WithImages(std::string json, const JobReport& report) {
  json.erase(json.rfind("\n}"));
  json += ",\n \"images\": [";
  const char* separator = "\n  ";
  for (const ReportImage& image : report.images) {
    std::string row = JsonText(ImageRow(image), -1);
    row.pop_back();
    json += separator + row;
    separator = ",\n  ";
  }
  return json + "\n ]\n}\n";
}

Json Adjustments(const JobReport& report) {
  Json list = Json::array();
  for (const ReportAdjustment& adjustment : report.adjustments) {
    Json phases = Json::array();
    for (const ReportPhase& phase : adjustment.phases) {
      phases.push_back({{"steps", phase.steps},
                        {"converged", phase.converged},
                        {"accepted_costs", phase.accepted_costs}});
    }
    list.push_back(
        {{"rounds", std::move(phases)}, {"bytes_of_block", adjustment.bytes_of_subproblem}});
  }
  return list;
}

Json Workers(const JobReport& report) {
  Json list = Json::array();
  for (const ReportWorker& worker : report.workers) {
    list.push_back(
        {{"name", worker.name}, {"slots", worker.slots}, {"tasks_done", worker.tasks_done}});
  }
  return list;
}

}  // namespace

std::string ReportJson(const JobReport& report) {
  Json json;
  json["version"] = report.version;
  json["title"] = report.title;
  json["verdict"] = {{"level", LevelText(report.verdict.level)},
                     {"reasons", report.verdict.reasons},
                     {"unchecked", report.verdict.unchecked}};
  json["images_total"] = report.images_total;
  json["registered"] = report.registered;
  json["not_registered"] = NotRegistered(report);
  json["models"] = report.models;
  json["each_model"] = EachModel(report);
  json["points"] = report.points;
  json["observations"] = report.observations;
  json["mean_track_length"] = report.mean_track_length;
  json["residual_px_mean"] = report.residual_px_mean;
  json["residual_px_rms"] = report.residual_px_rms;
  json["residual_erp_px"] = report.residual_erp_px_mean;
  json["residual_histogram"] = {{"bin_width_px", report.residual_histogram.bin_width},
                                {"counts", report.residual_histogram.counts}};
  json["track_lengths"] = report.track_lengths;
  json["clusters"] = Clusters(report);
  json["seams"] = Seams(report);
  for (const auto& [rung, name] : EnumNames<MatchRung>::kNames) {
    json["pairs_by_rung"][std::string(name)] = report.pairs_of_rung[static_cast<size_t>(rung)];
  }
  json["wider_pairs"] = {{"facades", report.wider_pairs.facades},
                         {"second", report.wider_pairs.second},
                         {"held_back", report.wider_pairs.held_back},
                         {"reserve", report.wider_pairs.reserve},
                         {"predicted", report.wider_pairs.predicted},
                         {"thin_images", report.wider_pairs.thin_images}};
  json["checks"] = Checks(report);
  json["gnss"] = Gnss(report.gnss);
  json["gnss"]["contradicted"] = Contradicted(report);
  json["uncertainty"] =
      Uncertainty(report.uncertainty,
                  report.each_model.empty() ? ReportModel{} : report.each_model.front(),
                  report);
  if (report.models > 1) json["uncertainty"]["model"] = 0;
  json["global_adjustment"] = Adjustments(report);
  json["stages"] = StagesJson(report.stages);
  json["workers"] = Workers(report);
  json["elapsed_s"] = report.elapsed_s;
  json["warnings"] = CountedLines(report.warnings);
  json["warnings_in_full"] = report.warnings;
  json["options"] = report.options_text;
  return WithImages(JsonText(json), report);
}

}  // namespace orbweave
