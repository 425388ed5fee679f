// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/inspect/inspect_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "cli/inspect/fetch_pairs.h"
#include "cli/inspect/image_state.h"
#include "cli/inspect/tracks_of_images.h"
#include "core/drawing/draw_pair.h"
#include "core/geometry/rotation.h"
#include "core/io/printable_text.h"
#include "stages/match_images/inspect_pair.h"
#include "stages/match_images/pair_seed.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// All that is known of the pair (a, b), a < b.
struct PairFacts {
  ImagePair pair{};
  bool is_swapped = false;  ///< b was named first
  bool was_tried = false;
  bool was_verified = false;
  PairInspection inspection{};
  std::optional<JobResults> results{};
  uint32_t common_points = 0;
  std::string remark{};  ///< on the pixels
  SceneFeatures a{};     ///< by whose numbers the inspection names features
  SceneFeatures b{};

  [[nodiscard]] ImageId First() const { return is_swapped ? pair.b : pair.a; }
  [[nodiscard]] ImageId Second() const { return is_swapped ? pair.a : pair.b; }
};

std::string KindText(TwoViewKind kind) {
  switch (kind) {
    case TwoViewKind::kGeneral:
      return "general";
    case TwoViewKind::kPlanar:
      return "planar (nearly all inliers lie on one plane)";
    case TwoViewKind::kPureRotation:
      return "pure rotation (both share a centre)";
    case TwoViewKind::kNone:
      break;
  }
  return "none";
}

std::string DirectionText(const Vector3d& bearing) {
  return absl::StrFormat("azimuth %.1f deg, elevation %.1f deg",
                         std::atan2(bearing.x(), bearing.z()) * kDegreesPerRadian,
                         -std::asin(std::clamp(bearing.y(), -1.0, 1.0)) * kDegreesPerRadian);
}

/// From the image named first to the second, |translation| = 1 or 0.
Rigid3 SecondFromFirst(const PairFacts& facts) {
  const Rigid3& b_from_a = facts.inspection.geometry.b_from_a;
  return facts.is_swapped ? b_from_a.Inverse() : b_from_a;
}

/// Of the second image's centre seen from the first, when the geometry tells.
std::optional<Vector3d> Baseline(const PairFacts& facts) {
  const TwoViewKind kind = facts.inspection.geometry.kind;
  if (!HasBaseline(kind)) return std::nullopt;
  return SecondFromFirst(facts).Centre().normalized();
}

/// Of a feature that was matched.
FeatureIndex NumberInScene(const SceneFeatures& scene, FeatureIndex feature) {
  return static_cast<FeatureIndex>(std::ranges::lower_bound(scene.index, feature) -
                                   scene.index.begin());
}

absl::StatusOr<PairFacts> GatherFacts(InspectedJob& job, ImageId first, ImageId second) {
  const ImagePair pair = MakePair(first, second);
  PairFacts facts{.pair = pair, .is_swapped = second < first};
  ORBWEAVE_ASSIGN_OR_RETURN(
      const JobPairs pairs,
      FetchPairs(job.blobs(), job.status().spec, job.outcomes(), [&](const ImagePair& each) {
        return each == pair;
      }));
  facts.was_tried = !pairs.tried.empty();
  facts.was_verified = !pairs.verified.empty();
  ORBWEAVE_ASSIGN_OR_RETURN(const Features a, job.FetchFeaturesOf(pair.a));
  ORBWEAVE_ASSIGN_OR_RETURN(const Features b, job.FetchFeaturesOf(pair.b));
  facts.a = job.SceneOf(pair.a, a);
  facts.b = job.SceneOf(pair.b, b);
  std::optional<TwoViewGeometry> verified;
  if (facts.was_verified) {
    verified = pairs.verified.front();
    for (FeatureMatch& match : verified->inliers)
      match = {NumberInScene(facts.a, match.a), NumberInScene(facts.b, match.b)};
  }
  ORBWEAVE_ASSIGN_OR_RETURN(
      facts.inspection,
      InspectPair(pair,
                  PairSide(facts.a.features),
                  PairSide(facts.b.features),
                  facts.was_tried ? pairs.tried.front().matches : std::vector<FeatureMatch>{},
                  verified,
                  job.options().matching,
                  job.options().two_view,
                  {.seed = PairSeed(job.FeatureNames()->at(pair.a.value),
                                    job.FeatureNames()->at(pair.b.value))}));
  TracksOfImages tracks({pair.a, pair.b});
  ORBWEAVE_ASSIGN_OR_RETURN(facts.results, job.Results(tracks));
  facts.common_points = tracks.num_common();
  return facts;
}

std::string MatchesText(const PairInspection& inspection) {
  const size_t inliers = inspection.geometry.inliers.size();
  const size_t more = inspection.num_guided + inspection.num_on_facades;
  std::string text = absl::StrFormat("%u inliers", inliers);
  if (more == 0) return text + absl::StrFormat(" of %u matches", inspection.putative.size());
  absl::StrAppendFormat(
      &text, ", %u of %u matches by descriptors", inliers - more, inspection.putative.size());
  if (inspection.num_on_facades > 0)
    absl::StrAppendFormat(&text, ", %u of walls in their true shape", inspection.num_on_facades);
  if (inspection.num_guided > 0)
    absl::StrAppendFormat(&text, ", %u more found along epipolar planes", inspection.num_guided);
  return text;
}

/// What the best geometry of a pair lacks of what the options ask for.
std::string ShortfallText(const PairInspection& inspection, const TwoViewOptions& options) {
  const TwoViewGeometry& geometry = inspection.geometry;
  const auto inliers = static_cast<double>(geometry.inliers.size());
  if (inliers < options.min_inliers)
    return absl::StrCat("two_view.min_inliers=", options.min_inliers, " are asked for");
  if (geometry.log10_false_alarms > options.max_log10_false_alarms) {
    return absl::StrFormat(
        "as many agree by chance in %.2g of a hundred such pairs "
        "(two_view.max_log10_false_alarms=%g)",
        100.0 * std::min(1.0, std::pow(10.0, geometry.log10_false_alarms)),
        options.max_log10_false_alarms);
  }
  if (inliers < options.min_inlier_share * static_cast<double>(inspection.putative.size()))
    return absl::StrFormat("two_view.min_inlier_share=%g is asked for", options.min_inlier_share);
  return "found by a search that takes whatever there is, not by that of the job";
}

/// What became of the pair, and why.
std::string VerdictText(const InspectedJob& job, const PairFacts& facts) {
  const PairInspection& inspection = facts.inspection;
  std::string text;
  if (!facts.was_tried) {
    text = job.status().spec.kind == "sparse"
               ? "not tried: " + WhyNotSelected(job.manifest(), facts.pair, job.options().pairs) +
                     " - tried now: "
               : "the database has no matches of it";
    if (inspection.putative.empty()) return text;
  }
  switch (inspection.verdict) {
    case PairVerdict::kVerified:
      return text + (facts.was_tried ? "verified, " : "would be verified, ") +
             KindText(inspection.geometry.kind) +
             (inspection.geometry.rung == MatchRung::kPropagated ? ", as others predict it: "
                                                                 : ": ") +
             MatchesText(inspection);
    case PairVerdict::kRejected:
      return text +
             absl::StrFormat("not verified: the best geometry of %u matches has %u inliers; %s",
                             inspection.putative.size(),
                             inspection.geometry.inliers.size(),
                             ShortfallText(inspection, job.options().two_view));
    case PairVerdict::kNothing:
      break;
  }
  if (inspection.putative.size() < 8)
    return text + absl::StrFormat("not verified: only %u matches", inspection.putative.size());
  return text + absl::StrFormat("not verified: %u matches, no geometry explains eight of them",
                                inspection.putative.size());
}

std::string GeometryText(const PairFacts& facts) {
  const TwoViewGeometry& geometry = facts.inspection.geometry;
  if (geometry.kind == TwoViewKind::kNone) return "";
  std::string text = absl::StrFormat("turned by %.1f deg",
                                     RotationAngle(geometry.b_from_a.rotation) * kDegreesPerRadian);
  if (const auto baseline = Baseline(facts))
    absl::StrAppend(&text, ", from the first to the second ", DirectionText(*baseline));
  const double spread_in_b = facts.inspection.spread_in_b;
  absl::StrAppendFormat(&text,
                        "; spread over %.0f %% and %.0f %% of the spheres, %.1f deg at the points "
                        "and %.2f px off in the median",
                        100.0 * (facts.is_swapped ? spread_in_b : geometry.spread),
                        100.0 * (facts.is_swapped ? geometry.spread : spread_in_b),
                        geometry.median_angle_rad * kDegreesPerRadian,
                        facts.inspection.residual_px_median);
  return text;
}

/// Whether the reconstruction took the pair.
std::string ViewGraphText(const PairFacts& facts) {
  if (!facts.results || !facts.was_verified) return "";
  for (const DroppedEdge& dropped : facts.results->view_graph.dropped) {
    if (dropped.pair == facts.pair) return "not used: " + dropped.reason;
  }
  std::string text = "used";
  for (const ClusterSummary& cluster : facts.results->clusters) {
    if (std::ranges::find(cluster.contradicted_pairs, facts.pair) !=
        cluster.contradicted_pairs.end()) {
      absl::StrAppend(&text, ", but contradicts the model of cluster ", cluster.cluster);
    }
  }
  return text;
}

/// How the model that holds both agrees with their own geometry.
std::string ModelText(const PairFacts& facts) {
  if (!facts.results) return "";
  for (size_t m = 0; m < facts.results->models.size(); ++m) {
    const AdjustedModel& model = facts.results->models[m];
    const auto a = model.images.find(facts.pair.a);
    const auto b = model.images.find(facts.pair.b);
    if (a == model.images.end() || b == model.images.end()) continue;
    if (a->second.loose || b->second.loose) continue;
    const Rigid3 b_from_a = b->second.cam_from_world * a->second.cam_from_world.Inverse();
    const Rigid3 second_from_first = facts.is_swapped ? b_from_a.Inverse() : b_from_a;
    std::string text = absl::StrFormat("%u holds both, %.3f %s apart, with %u points seen by both",
                                       m,
                                       b_from_a.translation.norm(),
                                       model.report.gnss.used ? "m" : "units",
                                       facts.common_points);
    const TwoViewGeometry& geometry = facts.inspection.geometry;
    if (geometry.kind == TwoViewKind::kNone) return text;
    absl::StrAppendFormat(
        &text,
        "; it turns by %.2f deg",
        RotationAngle(b_from_a.rotation * geometry.b_from_a.rotation.conjugate()) *
            kDegreesPerRadian);
    if (const auto baseline = Baseline(facts)) {
      absl::StrAppendFormat(
          &text,
          " and looks %.2f deg off the pair's own geometry",
          AngleBetween(second_from_first.Centre(), *baseline) * kDegreesPerRadian);
    } else {
      absl::StrAppend(&text, " off the pair's own rotation");
    }
    return text;
  }
  return "no model holds both";
}

std::string GnssText(const ImageManifest& manifest, ImagePair pair) {
  const auto& a = manifest.At(pair.a).prior.position_in_enu;
  const auto& b = manifest.At(pair.b).prior.position_in_enu;
  if (!a || !b) return "";
  return absl::StrFormat("%.1f m apart, %.1f m of it in height", (*b - *a).norm(), b->z() - a->z());
}

struct NamedLine {
  std::string name{};
  std::string text{};
};

std::vector<NamedLine> LinesOf(const InspectedJob& job, const PairFacts& facts) {
  std::vector<NamedLine> lines;
  const auto add = [&](const std::string& name, const std::string& text) {
    if (!text.empty()) lines.push_back({name, PrintableText(text)});
  };
  add("first", ImageStateText(job, facts.results, facts.First()));
  add("second", ImageStateText(job, facts.results, facts.Second()));
  add("pair", VerdictText(job, facts));
  add("geometry", GeometryText(facts));
  add("view graph", ViewGraphText(facts));
  add("model", ModelText(facts));
  add("GNSS", GnssText(job.manifest(), facts.pair));
  add("note", facts.remark);
  return lines;
}

/// The matches with `first` above.
std::vector<PictureMatch> PictureMatches(const std::vector<FeatureMatch>& matches,
                                         const Features& a,
                                         const Features& b,
                                         const Eigen::Quaterniond& R,
                                         bool is_swapped) {
  std::vector<PictureMatch> drawn;
  for (const FeatureMatch& match : matches) {
    const Keypoint& at_a = a.keypoints[match.a];
    const Keypoint& at_b = b.keypoints[match.b];
    PictureMatch each{.a_px = {at_a.x_px, at_a.y_px},
                      .b_px = {at_b.x_px, at_b.y_px},
                      .angle_rad = AngleBetween(R * a.Bearing(match.a), b.Bearing(match.b))};
    if (is_swapped) std::swap(each.a_px, each.b_px);
    drawn.push_back(each);
  }
  return drawn;
}

absl::StatusOr<std::string> Draw(InspectedJob& job, PairFacts& facts) {
  const PairInspection& inspection = facts.inspection;
  const Features& a = facts.a.features;
  const Features& b = facts.b.features;
  const Eigen::Quaterniond& R = inspection.geometry.b_from_a.rotation;
  PairPicture picture{
      .a = job.Picture(facts.First(), facts.remark),
      .b = job.Picture(facts.Second(), facts.remark),
      .outliers = PictureMatches(inspection.Outliers(), a, b, R, facts.is_swapped),
      .inliers = PictureMatches(inspection.geometry.inliers, a, b, R, facts.is_swapped),
      .is_verified = inspection.verdict == PairVerdict::kVerified};
  if (inspection.geometry.kind != TwoViewKind::kNone)
    picture.b_from_a = SecondFromFirst(facts).rotation;
  picture.baseline_in_a = Baseline(facts);
  picture.headlines = {picture.a.name + "   and   " + picture.b.name};
  for (const NamedLine& line : LinesOf(job, facts)) {
    if (line.name == "first" || line.name == "second" || line.name == "note") continue;
    picture.headlines.push_back(line.name + ": " + line.text);
  }
  return DrawPair(picture);
}

}  // namespace

absl::StatusOr<Inspection> InspectPairOfJob(InspectedJob& job, ImageId first, ImageId second) {
  ORBWEAVE_ASSIGN_OR_RETURN(PairFacts facts, GatherFacts(job, first, second));
  const ImageManifest& manifest = job.manifest();
  Inspection inspection{
      .file_name = absl::StrCat(
          FileStemOf(manifest.At(first).name), "--", FileStemOf(manifest.At(second).name), ".png")};
  ORBWEAVE_ASSIGN_OR_RETURN(inspection.png, Draw(job, facts));
  for (const NamedLine& line : LinesOf(job, facts))
    absl::StrAppendFormat(&inspection.text, "%-10s %s\n", line.name, line.text);
  return inspection;
}

}  // namespace orbweave
