// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_stretches.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/merging/georeference/drive_sequences.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr size_t kFewest = 4;
constexpr double kOtherScale = 1.5;
constexpr double kSigmas = 3.0;
constexpr double kAsStraight = 4.0 / 3.0;

/// A way from the first place to the last.
struct Way {
  double across = 0.0;  ///< distance of the two
  double along = 0.0;

  void Add(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    along += (to - from).head<2>().norm();
  }
  [[nodiscard]] bool IsAsStraightAs(const Way& other) const {
    return along * other.across <= kAsStraight * other.along * across;
  }
};

/// A stretch that GNSS has of another length.
struct Stretch {
  std::vector<ImageId> images{};
  double in_model_m = 0.0;
  double by_gnss_m = 0.0;

  [[nodiscard]] double Factor() const {
    return std::max(in_model_m, by_gnss_m) / std::max(std::min(in_model_m, by_gnss_m), 1e-9);
  }
};

std::optional<Stretch> AskStretch(std::span<const ImageId> images,
                                  const std::map<ImageId, Eigen::Vector3d>& places,
                                  const ImageManifest& manifest) {
  if (images.size() < kFewest) return std::nullopt;
  const auto prior = [&](ImageId id) -> const PosePrior& { return manifest.At(id).prior; };
  const auto distance = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).head<2>().norm();
  };
  const ImageId first = images.front();
  const ImageId last = images.back();
  Way model{.across = distance(places.at(first), places.at(last))};
  Way gnss{.across = DistanceBetween(prior(first), prior(last))};
  for (size_t i = 0; i + 1 < images.size(); ++i) {
    model.Add(places.at(images[i]), places.at(images[i + 1]));
    gnss.Add(*prior(images[i]).position_in_enu, *prior(images[i + 1]).position_in_enu);
  }
  const Stretch stretch{{images.begin(), images.end()}, model.across, gnss.across};
  const bool differs =
      std::abs(gnss.across - model.across) > kSigmas * SigmaBetween(prior(first), prior(last));
  if (!differs || stretch.Factor() < kOtherScale || !gnss.IsAsStraightAs(model))
    return std::nullopt;
  return stretch;
}

/// The stretches of one model, in the order of its drives.
std::vector<Stretch> StretchesOf(const AdjustedModel& model, const ImageManifest& manifest) {
  const GnssReport& gnss = model.report.gnss;
  const std::set<std::string> contradicted(gnss.outliers.begin(), gnss.outliers.end());
  std::map<ImageId, Eigen::Vector3d> places;
  for (const auto& [id, image] : model.images) {
    if (!image.loose && manifest.At(id).prior.position_in_enu)
      places[id] = image.cam_from_world.Centre();
  }
  std::vector<Stretch> stretches;
  for (const DriveSequence& sequence : DriveSequences(places, manifest)) {
    const std::span<const ImageId> images = sequence.images;
    size_t first = 0;
    for (size_t i = 0; i <= images.size(); ++i) {
      if (i < images.size() && contradicted.contains(manifest.At(images[i]).name)) continue;
      if (auto stretch = AskStretch(images.subspan(first, i - first), places, manifest))
        stretches.push_back(*std::move(stretch));
      first = i + 1;
    }
  }
  return stretches;
}

}  // namespace

CrossCheck CheckStretches(const JobResults& results) {
  CrossCheck check{.name = "stretch_lengths", .value = 1.0, .limit = kOtherScale, .unit = "factor"};
  std::optional<Stretch> worst;
  size_t count = 0;
  for (const AdjustedModel& model : results.models) {
    if (!model.report.gnss.used) continue;
    for (Stretch& stretch : StretchesOf(model, results.manifest)) {
      ++count;
      if (!worst || stretch.Factor() > worst->Factor()) worst = std::move(stretch);
    }
  }
  if (!worst) {
    check.sentence = "no stretch of panoramas has another length than its positions";
    return check;
  }
  check.value = worst->Factor();
  check.level = CheckLevel::kDoubtful;
  check.sentence = absl::StrFormat(
      "%d panoramas in a row, from %s to %s, extend over %.1f m of the model and over %.1f m by "
      "their positions, which it contradicts%s: either these are wrong, or the model has that "
      "stretch of another scale, as hardly a point holds it to the rest",
      worst->images.size(),
      results.manifest.At(worst->images.front()).name,
      results.manifest.At(worst->images.back()).name,
      worst->in_model_m,
      worst->by_gnss_m,
      count > 1 ? absl::StrFormat(" (%d such stretches)", count) : "");
  return check;
}

}  // namespace orbweave
