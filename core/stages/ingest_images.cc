// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/stages/ingest_images.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "absl/strings/str_cat.h"
#include "core/io/gnss_table.h"
#include "core/io/match_names.h"
#include "core/io/natural_order.h"
#include "core/scene/local_frame.h"

namespace orbweave {
namespace {

constexpr int kAspectTolerancePx = 1;
constexpr double kUnknownAltitudeSigmaM = 100.0;
constexpr double kFarthestFromMedianM = 1e6;
// Coarse, so that the frame does not move with the noise of the positions.
constexpr double kOriginStepDeg = 1e-3;  ///< about 100 m
constexpr double kOriginStepM = 10.0;
constexpr size_t kNamesInWarning = 5;
constexpr size_t kRowsInWarnings = 20;

/// A source that takes part, with its table row if it has one.
struct Candidate {
  const SourceImage* source = nullptr;
  const GnssRow* row = nullptr;
};

std::string SizeText(int width_px, int height_px) { return absl::StrCat(width_px, "x", height_px); }

/// "3 images have no mask: a.jpg, b.jpg, c.jpg"; nothing for no names.
void WarnOfNames(const std::vector<std::string>& names,
                 const char* one,
                 const char* many,
                 ImageManifest& manifest) {
  if (names.empty()) return;
  std::string text = absl::StrCat(names.size(), " ", names.size() == 1 ? one : many, ": ");
  for (size_t i = 0; i < std::min(names.size(), kNamesInWarning); ++i)
    absl::StrAppend(&text, i == 0 ? "" : ", ", names[i]);
  manifest.warnings.push_back(names.size() > kNamesInWarning ? text + ", ..." : text);
}

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

void WarnOfRejectedRows(const GnssTable& table, ImageManifest& manifest) {
  for (size_t i = 0; i < std::min(table.rejected.size(), kRowsInWarnings); ++i) {
    manifest.warnings.push_back(
        absl::StrCat(table.rejected[i].name, " is not used: ", table.rejected[i].reason));
  }
  if (table.rejected.size() > kRowsInWarnings) {
    manifest.warnings.push_back(
        absl::StrCat(table.rejected.size() - kRowsInWarnings, " more rows are not used"));
  }
}

/// Gives each candidate its row; rows that mean no source at all become a warning.
std::vector<Candidate> JoinRows(const std::vector<const SourceImage*>& images,
                                const GnssTable& table,
                                const std::string& table_name,
                                ImageManifest& manifest) {
  std::vector<std::string> image_names;
  std::vector<std::string> row_names;
  for (const SourceImage* image : images) image_names.push_back(image->name);
  for (const GnssRow& row : table.rows) row_names.push_back(row.name);
  const std::vector<std::optional<size_t>> row_of_image = MatchNames(image_names, row_names);
  std::vector<Candidate> candidates;
  std::vector<bool> used(table.rows.size(), false);
  for (size_t i = 0; i < images.size(); ++i) {
    Candidate& candidate = candidates.emplace_back(Candidate{images[i], nullptr});
    if (!row_of_image[i]) continue;
    candidate.row = &table.rows[*row_of_image[i]];
    used[*row_of_image[i]] = true;
  }
  std::vector<std::string> unused;
  for (size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) unused.push_back(row_names[i]);
  }
  WarnOfNames(unused,
              absl::StrCat("row of ", table_name, " has no image").c_str(),
              absl::StrCat("rows of ", table_name, " have no image").c_str(),
              manifest);
  return candidates;
}

/// Keeps those that can take part; the others go to manifest.excluded.
std::vector<Candidate> SelectUsable(const std::vector<Candidate>& candidates,
                                    ImageManifest& manifest) {
  std::vector<Candidate> usable;
  std::map<Digest, std::string> name_of_content;
  for (const Candidate& candidate : candidates) {
    std::string reason = ReasonToExclude(*candidate.source, name_of_content);
    if (reason.empty()) {
      usable.push_back(candidate);
    } else {
      manifest.excluded.push_back({candidate.source->name, std::move(reason)});
    }
  }
  return usable;
}

double DistanceM(const GeodeticPosition& a, const GeodeticPosition& b) {
  return EnuFromGeodetic({a.latitude_deg, a.longitude_deg, 0.0},
                         {b.latitude_deg, b.longitude_deg, 0.0})
      .norm();
}

/// A table whose positions fit the images' own EXIF only with latitude and longitude exchanged.
absl::Status CheckNotSwapped(const std::vector<Candidate>& candidates,
                             const std::string& table_name) {
  size_t compared = 0;
  size_t swapped = 0;
  for (const Candidate& candidate : candidates) {
    const std::optional<GeodeticPosition>& exif = candidate.source->metadata.position;
    if (candidate.row == nullptr || !candidate.row->geodetic || !exif) continue;
    ++compared;
    const GeodeticPosition& given = *candidate.row->geodetic;
    if (std::abs(given.longitude_deg) > 90.0) continue;
    const GeodeticPosition exchanged{given.longitude_deg, given.latitude_deg, 0.0};
    if (DistanceM(given, *exif) > 1e5 && DistanceM(exchanged, *exif) < 1e4) ++swapped;
  }
  if (swapped == 0 || 2 * swapped < compared) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      table_name,
      ": latitude and longitude look swapped (exchanged, ",
      swapped,
      " of ",
      compared,
      " rows agree with the images' own EXIF positions); exchange the two columns or their names"));
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

/// Standard deviations of an image's position, before what is not known of its altitude.
Eigen::Vector2d SigmaOf(const Candidate& candidate, const IngestOptions& options) {
  const SourceImage& source = *candidate.source;
  double horizontal_m = options.gnss_sigma_m;
  if (candidate.row == nullptr && source.position_sigma_m) return *source.position_sigma_m;
  if (candidate.row == nullptr)
    horizontal_m = source.metadata.position_error_m.value_or(horizontal_m);
  if (candidate.row != nullptr) horizontal_m = candidate.row->accuracy_m.value_or(horizontal_m);
  return {horizontal_m, horizontal_m * options.gnss_vertical_factor};
}

/// The table's value, else that of the image's header.
std::optional<double> Either(const Candidate& candidate,
                             std::optional<double> GnssRow::*of_row,
                             std::optional<double> ImageMetadata::*of_header) {
  if (candidate.row != nullptr && candidate.row->*of_row) return candidate.row->*of_row;
  return candidate.source->metadata.*of_header;
}

PosePrior PriorOf(const Candidate& candidate, bool local, const IngestOptions& options) {
  PosePrior prior;
  const Eigen::Vector2d sigma_m = SigmaOf(candidate, options);
  prior.horizontal_sigma_m = sigma_m.x();
  prior.vertical_sigma_m = sigma_m.y();
  bool altitude_known = candidate.source->metadata.altitude_known;
  if (local) {
    prior.position_in_enu = candidate.row != nullptr ? candidate.row->position_in_local
                                                     : candidate.source->position_in_local;
  } else if (candidate.row != nullptr) {
    prior.geodetic = candidate.row->geodetic;
    altitude_known = candidate.row->altitude_known;
  } else {
    prior.geodetic = candidate.source->metadata.position;
  }
  if (prior.geodetic && !altitude_known) {
    prior.geodetic->altitude_m = NAN;  // until the others' median is known
    prior.vertical_sigma_m = std::max(prior.vertical_sigma_m, kUnknownAltitudeSigmaM);
  }
  prior.heading_deg = Either(candidate, &GnssRow::heading_deg, &ImageMetadata::heading_deg);
  prior.pitch_deg = Either(candidate, &GnssRow::pitch_deg, &ImageMetadata::pitch_deg);
  prior.roll_deg = Either(candidate, &GnssRow::roll_deg, &ImageMetadata::roll_deg);
  return prior;
}

/// Whether positions are local metres: those of the table decide, then any latitude and longitude.
bool PositionsAreLocal(const std::vector<Candidate>& candidates, const GnssTable& table) {
  if (!table.rows.empty()) return table.rows.front().position_in_local.has_value();
  return std::none_of(candidates.begin(), candidates.end(), [](const Candidate& candidate) {
    return candidate.source->metadata.position.has_value();
  });
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Degrees in (-180, 180].
double WrappedDegrees(double degrees) {
  return degrees - 360.0 * std::ceil((degrees - 180.0) / 360.0);
}

/// The rounded median of all positions; longitudes are taken about the first, so the date line is
/// nowhere special.
std::optional<GeodeticPosition> OriginOf(const std::vector<ImageRecord>& images) {
  std::vector<double> latitudes;
  std::vector<double> longitudes;
  std::vector<double> altitudes;
  double reference_deg = 0.0;
  for (const ImageRecord& image : images) {
    if (!image.prior.geodetic) continue;
    const GeodeticPosition& position = *image.prior.geodetic;
    if (latitudes.empty()) reference_deg = position.longitude_deg;
    latitudes.push_back(position.latitude_deg);
    longitudes.push_back(WrappedDegrees(position.longitude_deg - reference_deg));
    if (std::isfinite(position.altitude_m)) altitudes.push_back(position.altitude_m);
  }
  if (latitudes.empty()) return std::nullopt;
  const auto rounded = [](double degrees) {
    return std::round(degrees / kOriginStepDeg) * kOriginStepDeg;
  };
  return GeodeticPosition{rounded(Median(latitudes)),
                          rounded(WrappedDegrees(Median(longitudes) + reference_deg)),
                          std::round(Median(altitudes) / kOriginStepM) * kOriginStepM};
}

/// Fills position_in_enu; a position that is nowhere near the others is dropped with a warning.
void PlaceInLocalFrame(ImageManifest& manifest) {
  manifest.origin = OriginOf(manifest.images);
  if (!manifest.origin) return;
  for (ImageRecord& image : manifest.images) {
    std::optional<GeodeticPosition>& position = image.prior.geodetic;
    if (!position) continue;
    if (!std::isfinite(position->altitude_m)) position->altitude_m = manifest.origin->altitude_m;
    const Eigen::Vector3d point_in_enu = EnuFromGeodetic(*position, *manifest.origin);
    if (point_in_enu.norm() <= kFarthestFromMedianM) {
      image.prior.position_in_enu = point_in_enu;
      continue;
    }
    manifest.warnings.push_back(absl::StrCat("the position of ",
                                             image.name,
                                             " is ",
                                             std::round(point_in_enu.norm() / 1000.0),
                                             " km from the middle of all others; it is not used"));
    position.reset();
  }
}

/// Numbers drives: one per label of the table, and for images without label a new one after each
/// long pause.
void AssignDrives(const std::vector<Candidate>& candidates,
                  const IngestOptions& options,
                  ImageManifest& manifest) {
  uint32_t next_drive = 0;
  std::map<std::string, uint32_t> drive_of_label;
  std::optional<uint32_t> unlabelled;
  std::optional<double> last_time_s;
  for (size_t i = 0; i < candidates.size(); ++i) {
    ImageRecord& image = manifest.images[i];
    if (candidates[i].row != nullptr && candidates[i].row->drive) {
      const auto [drive, is_new] = drive_of_label.emplace(*candidates[i].row->drive, next_drive);
      if (is_new) ++next_drive;
      image.drive = drive->second;
      continue;
    }
    const bool paused = image.capture_time_s && last_time_s &&
                        std::abs(*image.capture_time_s - *last_time_s) > options.drive_gap_s;
    if (!unlabelled || paused) unlabelled = next_drive++;
    if (image.capture_time_s) last_time_s = image.capture_time_s;
    image.drive = *unlabelled;
  }
}

/// What the person who gave a table or masks will want to know of images that have none.
void WarnOfGaps(const std::vector<Candidate>& candidates,
                const GnssTable& table,
                const std::string& table_name,
                ImageManifest& manifest) {
  std::vector<std::string> without_row;
  std::vector<std::string> without_mask;
  for (const Candidate& candidate : candidates) {
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
    WarnOfRejectedRows(table, manifest);
  }
  const std::vector<Candidate> candidates =
      SelectUsable(JoinRows(InNaturalOrder(sources), table, sources.gnss_name, manifest), manifest);
  if (candidates.empty()) return NothingLeft(manifest);
  ORBWEAVE_RETURN_IF_ERROR(CheckNotSwapped(candidates, sources.gnss_name));
  const bool local = PositionsAreLocal(candidates, table);
  for (const Candidate& candidate : candidates) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    ImageRecord& record = manifest.images.emplace_back(
        RecordOf(*candidate.source, static_cast<uint32_t>(manifest.images.size()), manifest));
    record.prior = PriorOf(candidate, local, options);
    record.capture_time_s =
        Either(candidate, &GnssRow::capture_time_s, &ImageMetadata::capture_time_s);
    context.Report(manifest.images.size(), candidates.size(), "images");
  }
  PlaceInLocalFrame(manifest);
  AssignDrives(candidates, options, manifest);
  WarnOfGaps(candidates, table, sources.gnss_name, manifest);
  return manifest;
}

}  // namespace orbweave
