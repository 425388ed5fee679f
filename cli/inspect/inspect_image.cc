// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/inspect/inspect_image.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "cli/inspect/fetch_pairs.h"
#include "cli/inspect/image_state.h"
#include "cli/inspect/tracks_of_images.h"
#include "core/io/printable_text.h"
#include "core/report/build_job_report.h"

namespace orbweave {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr size_t kDirectionsShown = 12;

/// All that is known of one image.
struct ImageFacts {
  ImageId image{};
  Features features{};
  JobPairs pairs{};
  std::optional<JobResults> results{};
  std::optional<JobReport> report{};
  std::map<FeatureIndex, FeatureInModel> tracked{};
  size_t num_of_carrier = 0;  ///< features that were not matched
};

ImageId Partner(const ImagePair& pair, ImageId image) { return pair.a == image ? pair.b : pair.a; }

absl::StatusOr<ImageFacts> GatherFacts(InspectedJob& job, ImageId image) {
  ImageFacts facts{.image = image};
  ORBWEAVE_ASSIGN_OR_RETURN(
      facts.pairs,
      FetchPairs(job.blobs(), job.status().spec, job.outcomes(), [&](const ImagePair& pair) {
        return pair.a == image || pair.b == image;
      }));
  std::ranges::stable_sort(facts.pairs.verified, std::ranges::greater{}, [](const auto& geometry) {
    return geometry.inliers.size();
  });
  ORBWEAVE_ASSIGN_OR_RETURN(facts.features, job.FetchFeaturesOf(image));
  facts.num_of_carrier = facts.features.size() - job.SceneOf(image, facts.features).index.size();
  TracksOfImages tracks({image});
  ORBWEAVE_ASSIGN_OR_RETURN(facts.results, job.Results(tracks));
  if (facts.results) facts.report = BuildJobReport(*facts.results);
  facts.tracked = tracks.Of(image);
  return facts;
}

std::string FeaturesText(const ImageFacts& facts) {
  if (!facts.features.problem.empty()) return "none: " + facts.features.problem;
  std::string text =
      absl::StrFormat("%u, of which %u in tracks", facts.features.size(), facts.tracked.size());
  if (facts.num_of_carrier > 0)
    absl::StrAppendFormat(
        &text, "; %u go along with the camera and were not matched", facts.num_of_carrier);
  return text;
}

std::string ModelText(const ImageFacts& facts) {
  if (!facts.report) return "";
  const ReportImage& row = facts.report->images[facts.image.value];
  if (!row.registered || row.loose) return "";
  const bool is_metric = facts.results->models[row.model].report.gnss.used;
  const char* unit = is_metric ? "m" : "units";
  std::string text = absl::StrFormat(
      "%u observations, %.2f px off in the mean", row.observations, row.residual_px_mean);
  if (row.uncertainty && row.uncertainty->PositionSigma() == 0.0) {  // nothing else is so exact
    absl::StrAppend(&text, "; its pose counts as exact, the sigmas of others refer to it");
  } else if (row.uncertainty) {
    const Eigen::Vector3d sigmas = row.uncertainty->PositionSigmas();
    absl::StrAppendFormat(&text,
                          "; sigma of its centre %.4f %.4f %.4f %s, of its rotation %.4f deg",
                          sigmas.x(),
                          sigmas.y(),
                          sigmas.z(),
                          unit,
                          row.uncertainty->RotationSigma_deg());
  } else {
    absl::StrAppend(&text, "; its sigma is not known");
  }
  if (row.gnss_in_world) {
    absl::StrAppendFormat(&text,
                          "; %.2f m from its GNSS position%s",
                          (row.centre_in_world - *row.gnss_in_world).norm(),
                          row.gnss_outlier ? ", which the model contradicts" : "");
  }
  return text;
}

/// The cluster it is interior to, those that borrow it, and what each says of it.
std::string ClustersText(const ImageFacts& facts) {
  if (!facts.results) return "";
  std::vector<std::string> parts;
  const std::vector<Cluster>& clusters = facts.results->view_graph.partition.clusters;
  for (size_t c = 0; c < clusters.size(); ++c) {
    if (std::ranges::find(clusters[c].images, facts.image) == clusters[c].images.end()) continue;
    const bool is_interior =
        std::ranges::find(clusters[c].interior, facts.image) != clusters[c].interior.end();
    std::string part = absl::StrCat(c, is_interior ? "" : " (borrowed)");
    for (const ClusterSummary& cluster : facts.results->clusters) {
      if (cluster.cluster != c) continue;
      for (const NotRegistered& missing : cluster.not_registered) {
        if (missing.image == facts.image) absl::StrAppend(&part, " left it out: ", missing.reason);
      }
    }
    parts.push_back(std::move(part));
  }
  return parts.empty() ? "none" : absl::StrJoin(parts, "; ");
}

/// What became of a verified pair.
std::string RemarkOf(const JobResults& results, const ImagePair& pair) {
  for (const DroppedEdge& dropped : results.view_graph.dropped) {
    if (dropped.pair == pair) return "not used: " + dropped.reason;
  }
  for (const ClusterSummary& cluster : results.clusters) {
    if (std::ranges::find(cluster.contradicted_pairs, pair) != cluster.contradicted_pairs.end())
      return absl::StrCat("contradicts the model of cluster ", cluster.cluster);
  }
  return "";
}

const char* ShortKind(TwoViewKind kind) {
  if (kind == TwoViewKind::kPlanar) return "planar";
  return kind == TwoViewKind::kPureRotation ? "rotation" : "general";
}

std::string PairsTable(const InspectedJob& job, const ImageFacts& facts) {
  std::string text = absl::StrFormat(
      "pairs      %u tried, %u verified\n", facts.pairs.tried.size(), facts.pairs.verified.size());
  if (facts.pairs.verified.empty()) return text;
  absl::StrAppendFormat(&text,
                        "  %-32s %8s %8s %-9s %7s %9s  %s\n",
                        "partner",
                        "matches",
                        "inliers",
                        "kind",
                        "spread",
                        "angle",
                        "state");
  for (const TwoViewGeometry& geometry : facts.pairs.verified) {
    const ImageId partner = Partner(geometry.pair, facts.image);
    std::string state = facts.report ? RegistrationText(*facts.report, partner) : "";
    if (const size_t end = state.find(':'); end != std::string::npos) state.resize(end);
    const std::string remark = facts.results ? RemarkOf(*facts.results, geometry.pair) : "";
    if (!remark.empty()) absl::StrAppend(&state, "; ", remark);
    absl::StrAppendFormat(&text,
                          "  %-32s %8u %8u %-9s %5.0f %% %5.1f deg  %s\n",
                          PrintableText(job.manifest().At(partner).name),
                          geometry.num_putative,
                          geometry.inliers.size(),
                          ShortKind(geometry.kind),
                          100.0 * geometry.spread,
                          geometry.median_angle_rad * kDegreesPerRadian,
                          PrintableText(state));
  }
  return text;
}

/// Names of partners whose pairs have no geometry.
std::string FailedPairsText(const InspectedJob& job, const ImageFacts& facts) {
  constexpr size_t kShown = 8;
  std::vector<std::string> names;
  for (const MatchRecipe::Pair& tried : facts.pairs.tried) {
    const bool is_verified = std::ranges::any_of(
        facts.pairs.verified,
        [&](const TwoViewGeometry& geometry) { return geometry.pair == tried.pair; });
    if (!is_verified) names.push_back(job.manifest().At(Partner(tried.pair, facts.image)).name);
  }
  if (names.empty()) return "";
  const size_t total = names.size();
  names.resize(std::min(total, kShown));
  return absl::StrJoin(names, ", ") +
         (total > kShown ? absl::StrCat(" and ", total - kShown, " more") : "") +
         " (--pair shows why)";
}

/// Where the partner stands: by the model that holds both, else by the pair's own geometry.
std::optional<Eigen::Vector3d> DirectionTo(const ImageFacts& facts,
                                           const TwoViewGeometry& geometry) {
  const ImageId partner = Partner(geometry.pair, facts.image);
  if (facts.results) {
    for (const AdjustedModel& model : facts.results->models) {
      const auto own = model.images.find(facts.image);
      const auto other = model.images.find(partner);
      if (own == model.images.end() || other == model.images.end()) continue;
      if (own->second.loose || other->second.loose) continue;
      return (own->second.cam_from_world * other->second.cam_from_world.Centre()).normalized();
    }
  }
  if (geometry.kind == TwoViewKind::kPureRotation) return std::nullopt;
  return geometry.pair.a == facts.image ? geometry.b_from_a.Centre().normalized()
                                        : geometry.b_from_a.translation.normalized();
}

ImagePicture PictureOf(InspectedJob& job,
                       const ImageFacts& facts,
                       FeatureColors colors,
                       std::string& remark) {
  ImagePicture picture{.image = job.Picture(facts.image, remark), .colors = colors};
  for (FeatureIndex i = 0; i < facts.features.size(); ++i) {
    const Eigen::Vector2d at_px(facts.features.keypoints[i].x_px, facts.features.keypoints[i].y_px);
    const auto found = facts.tracked.find(i);
    if (found == facts.tracked.end()) {
      picture.unused_px.push_back(at_px);
    } else {
      picture.tracked.push_back({at_px, found->second.track_length, found->second.residual_px});
    }
  }
  for (const TwoViewGeometry& geometry : facts.pairs.verified) {
    if (picture.directions.size() == kDirectionsShown) break;
    const std::string& name = job.manifest().At(Partner(geometry.pair, facts.image)).name;
    if (const auto bearing = DirectionTo(facts, geometry))
      picture.directions.push_back(
          {*bearing, absl::StrCat(FileStemOf(name), "  ", geometry.inliers.size())});
  }
  return picture;
}

}  // namespace

absl::StatusOr<Inspection> InspectImageOfJob(InspectedJob& job,
                                             ImageId image,
                                             FeatureColors colors) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageFacts facts, GatherFacts(job, image));
  Inspection inspection{.file_name =
                            FileStemOf(job.manifest().At(image).name) +
                            (colors == FeatureColors::kResidual ? "-residual.png" : ".png")};
  std::string remark;
  ImagePicture picture = PictureOf(job, facts, colors, remark);
  picture.headlines = {PrintableText(ImageStateText(job, facts.results, image))};
  absl::StrAppendFormat(&inspection.text, "%-10s %s\n", "image", picture.headlines.front());
  const auto add = [&](const std::string& name, const std::string& text, bool in_picture) {
    if (text.empty()) return;
    absl::StrAppendFormat(&inspection.text, "%-10s %s\n", name, PrintableText(text));
    if (in_picture) picture.headlines.push_back(name + ": " + PrintableText(text));
  };
  add("features", FeaturesText(facts), true);
  add("model", ModelText(facts), true);
  add("clusters", ClustersText(facts), true);
  picture.headlines.push_back(absl::StrFormat(
      "pairs: %u tried, %u verified", facts.pairs.tried.size(), facts.pairs.verified.size()));
  absl::StrAppend(&inspection.text, PairsTable(job, facts));
  add("no pair", FailedPairsText(job, facts), false);
  add("note", remark, false);
  ORBWEAVE_ASSIGN_OR_RETURN(inspection.png, DrawImage(picture));
  return inspection;
}

}  // namespace orbweave
