// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_hinges.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/mapping/positioning/place_on_gnss.h"
#include "core/scene/image_manifest.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr double kKnownShare = 0.4;

/// A piece, and who of the rest of its model stands nearest to it.
struct AskedPiece {
  const HingedPiece* hinged = nullptr;
  ImageId nearest_in_piece{};
  ImageId nearest_in_rest{};
};

AskedPiece WithNearest(const AdjustedModel& model, const HingedPiece& hinged) {
  AskedPiece piece{.hinged = &hinged};
  std::vector<Eigen::Vector3d> centres;
  for (const ImageId id : hinged.images)
    centres.push_back(model.images.at(id).cam_from_world.Centre());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [id, image] : model.images) {
    if (image.loose || std::ranges::binary_search(hinged.images, id)) continue;
    const Eigen::Vector3d centre = image.cam_from_world.Centre();
    for (size_t i = 0; i < centres.size(); ++i) {
      const double distance = (centres[i] - centre).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      piece.nearest_in_piece = hinged.images[i];
      piece.nearest_in_rest = id;
    }
  }
  return piece;
}

/// Whether GNSS knows the way from one image to another.
bool IsKnown(const PosePrior& from, const PosePrior& to) {
  if (!from.position_in_enu || !to.position_in_enu) return false;
  return SigmaBetween(from, to) <= kKnownShare * DistanceBetween(from, to);
}

bool IsBorneOut(const AskedPiece& piece,
                const std::set<std::string_view>& contradicted,
                const ImageManifest& manifest) {
  const PosePrior& from = manifest.At(piece.nearest_in_rest).prior;
  size_t asked = 0;
  size_t agreeing = 0;
  bool is_known = false;
  for (const ImageId id : piece.hinged->images) {
    const ImageRecord& image = manifest.At(id);
    if (!image.prior.position_in_enu) continue;
    ++asked;
    agreeing += contradicted.contains(image.name) ? 0U : 1U;
    is_known |= IsKnown(from, image.prior);
  }
  return is_known &&
         static_cast<double>(agreeing) >= kMinAgreeingFixes * static_cast<double>(asked);
}

}  // namespace

CrossCheck CheckHinges(const JobResults& results) {
  CrossCheck check{.name = "hinges",
                   .value = kFewestThatTellSize,
                   .limit = kFewestThatTellSize,
                   .unit = "count",
                   .bound = CheckBound::kAtLeast};
  std::optional<AskedPiece> worst;
  size_t pieces = 0;
  size_t panoramas = 0;
  for (const AdjustedModel& model : results.models) {
    const GnssReport& gnss = model.report.gnss;
    const std::set<std::string_view> contradicted(gnss.outliers.begin(), gnss.outliers.end());
    for (const HingedPiece& hinged : model.hinged_pieces) {
      const AskedPiece piece = WithNearest(model, hinged);
      if (gnss.used && IsBorneOut(piece, contradicted, results.manifest)) continue;
      ++pieces;
      panoramas += hinged.images.size();
      if (!worst || hinged.points < worst->hinged->points) worst = piece;
    }
  }
  if (!worst) {
    check.sentence = "points that three panoramas see, or GNSS, hold every model together";
    return check;
  }
  check.value = worst->hinged->points;
  check.level = CheckLevel::kDoubtful;
  check.sentence = absl::StrFormat(
      "%d panoramas (pieces: %d) hang at the rest of their models by fewer than %d points that "
      "three panoramas see, first %s beside %s, by %d: how large such a piece is, and where it "
      "stands, a few points decide, which may be wrong; take panoramas closer together there, or "
      "give exact GNSS positions",
      panoramas,
      pieces,
      kFewestThatTellSize,
      results.manifest.At(worst->nearest_in_piece).name,
      results.manifest.At(worst->nearest_in_rest).name,
      worst->hinged->points);
  return check;
}

}  // namespace orbweave
