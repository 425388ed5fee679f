// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/join_gnss_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "absl/strings/str_cat.h"
#include "core/io/first_names.h"
#include "core/io/images/match_names.h"
#include "core/scene/local_frame.h"

namespace orbweave {
namespace {

constexpr size_t kNamesInWarning = 5;
constexpr size_t kRowsInWarnings = 20;

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

double DistanceM(const GeodeticPosition& a, const GeodeticPosition& b) {
  return EnuFromGeodetic({a.latitude_deg, a.longitude_deg, 0.0},
                         {b.latitude_deg, b.longitude_deg, 0.0})
      .norm();
}

}  // namespace

void WarnOfNames(const std::vector<std::string>& names,
                 const char* one,
                 const char* many,
                 ImageManifest& manifest) {
  if (names.empty()) return;
  manifest.warnings.push_back(absl::StrCat(
      names.size(), " ", names.size() == 1 ? one : many, ": ", FirstNames(names, kNamesInWarning)));
}

std::vector<IngestCandidate> JoinGnssRows(const std::vector<const SourceImage*>& images,
                                          const GnssTable& table,
                                          const std::string& table_name,
                                          ImageManifest& manifest) {
  WarnOfRejectedRows(table, manifest);
  manifest.warnings.insert(manifest.warnings.end(), table.warnings.begin(), table.warnings.end());
  std::vector<std::string> image_names;
  std::vector<std::string> row_names;
  for (const SourceImage* image : images) image_names.push_back(image->name);
  for (const GnssRow& row : table.rows) row_names.push_back(row.name);
  const std::vector<std::optional<size_t>> row_of_image = MatchNames(image_names, row_names);
  std::vector<IngestCandidate> candidates;
  std::vector<bool> used(table.rows.size(), false);
  for (size_t i = 0; i < images.size(); ++i) {
    IngestCandidate& candidate = candidates.emplace_back(IngestCandidate{images[i], nullptr});
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

absl::Status CheckNotSwapped(const std::vector<IngestCandidate>& candidates,
                             const std::string& table_name) {
  size_t compared = 0;
  size_t swapped = 0;
  for (const IngestCandidate& candidate : candidates) {
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

}  // namespace orbweave
