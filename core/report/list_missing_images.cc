// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/list_missing_images.h"

#include <map>

#include "absl/strings/str_cat.h"
#include "core/io/page/group_messages.h"
#include "core/report/check_standing_camera.h"

namespace orbweave {
namespace {

/// By the view graph alone: matched with none, or only with places that look alike; or in models
/// that nobody says more of.
std::vector<std::string> ReasonsByEdges(const JobResults& results) {
  std::vector<std::string> reasons(results.manifest.images.size(),
                                   "no verified matches with any other image");
  std::map<ImageId, uint32_t> dropped;
  for (const DroppedEdge& edge : results.view_graph.dropped) {
    if (edge.cause == DropCause::kGeometry) continue;
    ++dropped[edge.pair.a];
    ++dropped[edge.pair.b];
  }
  for (const auto& [image, count] : dropped) {
    reasons[image.value] =
        absl::StrCat(count,
                     count == 1 ? " verified pair" : " verified pairs",
                     " with others, and all told apart from them as places that look alike");
  }
  for (const ImagePair& pair : results.view_graph.edges) {
    for (const ImageId image : {pair.a, pair.b})
      reasons[image.value] = "no model that it was part of lasted";
  }
  return reasons;
}

/// Why each image that no model observes is missing, by what is known latest in the line.
std::vector<std::string> ReasonsOfImages(const JobResults& results) {
  std::vector<std::string> reasons = ReasonsByEdges(results);
  for (const ClusterSummary& cluster : results.clusters) {
    for (const NotRegistered& image : cluster.not_registered) {
      reasons[image.image.value] = image.reason;
    }
  }
  std::map<std::string, std::string> weak;
  for (const Exclusion& image : results.left_out) weak[image.name] = image.reason;
  const std::vector<std::string> standing = StandingReasons(results);
  for (size_t i = 0; i < standing.size(); ++i) {
    if (!standing[i].empty()) reasons[i] = standing[i];
  }
  for (const AdjustedModel& model : results.models) {
    for (const Exclusion& image : model.report.weak_images) weak[image.name] = image.reason;
  }
  for (const ImageRecord& image : results.manifest.images) {
    const auto found = weak.find(image.name);
    if (found != weak.end()) reasons[image.id.value] = found->second;
  }
  for (size_t i = 0; i < results.image_problems.size(); ++i) {
    if (!results.image_problems[i].empty()) reasons[i] = results.image_problems[i];
  }
  return reasons;
}

/// "16 images are placed loosely, not registered; for example 11 images: no verified matches, first
/// a.jpg".
std::string LooseWarning(const std::vector<Exclusion>& loose) {
  return absl::StrCat(loose.size(),
                      loose.size() == 1 ? " image is" : " images are",
                      " placed loosely, not registered; for example ",
                      CommonestLine(loose));
}

}  // namespace

void ListMissingImages(const JobResults& results, JobReport& report) {
  const std::vector<std::string> reasons = ReasonsOfImages(results);
  report.not_registered = results.manifest.excluded;
  std::vector<Exclusion> loose;
  for (size_t i = 0; i < report.images.size(); ++i) {
    ReportImage& row = report.images[i];
    if (row.registered && !row.loose) continue;
    row.reason = reasons[i];
    if (row.loose) loose.push_back({row.name, reasons[i]});
    report.not_registered.push_back(
        {row.name, reasons[i] + (row.loose ? "; it is placed loosely" : "")});
  }
  if (!loose.empty()) report.warnings.push_back(LooseWarning(loose));
}

}  // namespace orbweave
