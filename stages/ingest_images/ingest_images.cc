// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/ingest_images/ingest_images.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/io/natural_order.h"
#include "stages/ingest_images/assign_drives.h"
#include "stages/ingest_images/count_from_ellipsoid.h"
#include "stages/ingest_images/drop_placeholder_heights.h"
#include "stages/ingest_images/drop_shared_angles.h"
#include "stages/ingest_images/drop_stale_positions.h"
#include "stages/ingest_images/join_gnss_rows.h"
#include "stages/ingest_images/place_in_local_frame.h"
#include "stages/ingest_images/position_priors.h"

namespace orbweave {
namespace {

constexpr int kAspectTolerancePx = 1;

std::string SizeText(int width_px, int height_px) { return absl::StrCat(width_px, "x", height_px); }

/// Sources in natural order of their names.
std::vector<const SourceImage*> InNaturalOrder(const ImageSources& sources) {
  std::vector<const SourceImage*> images;
  for (const SourceImage& image : sources.images) images.push_back(&image);
  std::sort(images.begin(), images.end(), [](const SourceImage* a, const SourceImage* b) {
    return NaturalLess(a->name, b->name);
  });
  return images;
}

/// Why a source takes no part; empty when it does. Remembers the first name of every content.
std::string ReasonToExclude(const SourceImage& image,
                            std::map<Digest, std::string>& name_of_content) {
  const int width = image.metadata.width_px;
  const int height = image.metadata.height_px;
  if (!image.problem.empty()) return image.problem;
  if (std::abs(width - 2 * height) > kAspectTolerancePx) {
    return absl::StrCat(
        "it is ", SizeText(width, height), ", not 2:1: no full equirectangular panorama");
  }
  if (image.content.IsZero()) return "";
  const auto [first, is_new] = name_of_content.emplace(image.content, image.name);
  return is_new ? "" : absl::StrCat("it is byte for byte a copy of ", first->second);
}

absl::Status NothingLeft(const ImageManifest& manifest) {
  std::string text = absl::StrCat("none of the ", manifest.excluded.size(), " images can be used");
  for (size_t i = 0; i < std::min<size_t>(manifest.excluded.size(), 3); ++i) {
    absl::StrAppend(&text, "; ", manifest.excluded[i].name, ": ", manifest.excluded[i].reason);
  }
  return absl::InvalidArgumentError(text);
}

/// Keeps those that can take part; the others go to manifest.excluded.
std::vector<IngestCandidate> SelectUsable(const std::vector<IngestCandidate>& candidates,
                                          ImageManifest& manifest) {
  std::vector<IngestCandidate> usable;
  std::map<Digest, std::string> name_of_content;
  for (const IngestCandidate& candidate : candidates) {
    std::string reason = ReasonToExclude(*candidate.source, name_of_content);
    if (reason.empty()) {
      usable.push_back(candidate);
    } else {
      manifest.excluded.push_back({candidate.source->name, std::move(reason)});
    }
  }
  return usable;
}

/// Whether the mask, scaled to the image's width, has its height within a pixel.
bool HaveSameProportions(const SourceImage& source) {
  const double height_px =
      static_cast<double>(source.mask_height_px) * source.metadata.width_px / source.mask_width_px;
  return std::abs(height_px - source.metadata.height_px) <= 1.0;
}

/// Size, mask and name of one image.
ImageRecord RecordOf(const SourceImage& source, uint32_t index, ImageManifest& manifest) {
  ImageRecord record;
  record.id = ImageId(index);
  record.name = source.name;
  record.content = source.content;
  record.camera = {source.metadata.width_px, source.metadata.height_px};
  if (source.mask_path.empty()) return record;
  if (source.mask_width_px == 0) {
    manifest.warnings.push_back(absl::StrCat(
        "the mask ", source.mask_path, " cannot be read; ", source.name, " is used without it"));
  } else if (!HaveSameProportions(source)) {
    manifest.warnings.push_back(
        absl::StrCat("the mask ",
                     source.mask_path,
                     " is ",
                     SizeText(source.mask_width_px, source.mask_height_px),
                     ", its image ",
                     SizeText(record.camera.width_px, record.camera.height_px),
                     "; ",
                     source.name,
                     " is used without it"));
  } else {
    record.mask = source.mask;
  }
  return record;
}

/// The images whose position is that of EXIF and says that its altitude is above the ellipsoid.
std::set<ImageId> WithAltitudeOfEllipsoid(const std::vector<IngestCandidate>& candidates) {
  std::set<ImageId> images;
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].row == nullptr && candidates[i].source->metadata.altitude_of_ellipsoid)
      images.insert(ImageId(static_cast<uint32_t>(i)));
  }
  return images;
}

/// What the person who gave a table or masks will want to know of images that have none.
void WarnOfGaps(const std::vector<IngestCandidate>& candidates,
                const GnssTable& table,
                const std::string& table_name,
                ImageManifest& manifest) {
  std::vector<std::string> without_row;
  std::vector<std::string> without_mask;
  for (const IngestCandidate& candidate : candidates) {
    if (candidate.row == nullptr) without_row.push_back(candidate.source->name);
    if (candidate.source->mask_path.empty()) without_mask.push_back(candidate.source->name);
  }
  if (!table.rows.empty()) {
    WarnOfNames(without_row,
                absl::StrCat("image has no row in ", table_name).c_str(),
                absl::StrCat("images have no row in ", table_name).c_str(),
                manifest);
  }
  if (without_mask.size() < candidates.size()) {
    WarnOfNames(without_mask, "image has no mask", "images have no mask", manifest);
  }
}

/// Where no position has a height.
void WarnOfUnknownHeights(ImageManifest& manifest) {
  size_t count = 0;
  for (const ImageRecord& image : manifest.images) {
    if (!image.prior.position_in_enu) continue;
    if (IsHeightKnown(image.prior.vertical_sigma_m)) return;
    ++count;
  }
  if (count == 0) return;
  manifest.warnings.push_back(
      absl::StrCat("none of the ",
                   count,
                   " positions has a height: heights of the model are known but for a shift, and "
                   "cameras alone tell how it tilts"));
}

}  // namespace

absl::StatusOr<ImageManifest> IngestImages(const ImageSources& sources,
                                           const IngestOptions& options,
                                           const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(ValidateOptions("ingest", options));
  ImageManifest manifest;
  manifest.mask_ignores_white = sources.mask_ignores_white;
  manifest.warnings = sources.warnings;
  GnssTable table;
  if (!sources.gnss_text.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(table, ParseGnssTable(sources.gnss_text, sources.gnss_name));
  }
  const std::vector<IngestCandidate> candidates = SelectUsable(
      JoinGnssRows(InNaturalOrder(sources), table, sources.gnss_name, manifest), manifest);
  if (candidates.empty()) return NothingLeft(manifest);
  ORBWEAVE_RETURN_IF_ERROR(CheckNotSwapped(candidates, sources.gnss_name));
  const bool local = PositionsAreLocal(candidates, table);
  for (const IngestCandidate& candidate : candidates) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    ImageRecord& record = manifest.images.emplace_back(
        RecordOf(*candidate.source, static_cast<uint32_t>(manifest.images.size()), manifest));
    record.prior = PriorOf(candidate, local, options);
    context.Report(manifest.images.size(), candidates.size(), "images");
  }
  DropPlaceholderHeights(candidates, manifest);
  ORBWEAVE_RETURN_IF_ERROR(
      CountFromEllipsoid(options.height, WithAltitudeOfEllipsoid(candidates), manifest));
  PlaceInLocalFrame(manifest);
  DropSharedAngles(candidates, manifest);
  SetCaptureTimes(candidates, manifest);
  AssignDrives(candidates, options.drive_gap_s, manifest);
  DropStalePositions(manifest);
  WarnOfUnknownHeights(manifest);
  WarnOfGaps(candidates, table, sources.gnss_name, manifest);
  return manifest;
}

}  // namespace orbweave
