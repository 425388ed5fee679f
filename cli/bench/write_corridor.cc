// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/bench/write_corridor.h"

#include <vector>

#include "absl/strings/str_format.h"
#include "core/io/colmap/write_colmap_database.h"
#include "core/io/file.h"
#include "core/io/page/cameras_csv.h"
#include "core/synthetic/corridor.h"
#include "core/synthetic/make_corridor.h"

namespace orbweave {
namespace {

std::string GnssCsv(const ImageManifest& manifest) {
  std::string csv = "name,latitude,longitude,altitude,accuracy,drive,time\n";
  for (const ImageRecord& image : manifest.images) {
    if (!image.prior.geodetic) continue;
    absl::StrAppendFormat(
        &csv,
        "%s,%.9f,%.9f,%s,%.3f,%d,%s\n",
        image.name,
        image.prior.geodetic->latitude_deg,
        image.prior.geodetic->longitude_deg,
        IsHeightKnown(image.prior.vertical_sigma_m)
            ? absl::StrFormat("%.4f", image.prior.geodetic->altitude_m)
            : "",
        image.prior.horizontal_sigma_m,
        image.drive,
        image.capture_time_s ? absl::StrFormat("%.3f", *image.capture_time_s) : "");
  }
  return csv;
}

std::string TruthCsv(const Corridor& corridor) {
  Reconstruction truth;
  for (const ImageRecord& image : corridor.manifest.images) {
    truth.images[image.id].cam_from_world = corridor.cams_from_world[image.id.value];
  }
  return CamerasCsv(truth.images, corridor.manifest, false);
}

std::vector<TwoViewGeometry> VerifiedPairs(Corridor& corridor) {
  std::vector<TwoViewGeometry> pairs;
  for (PairMatches& pair : corridor.pairs) {
    const auto count = static_cast<uint32_t>(pair.matches.size());
    pairs.push_back({.pair = pair.pair, .inliers = std::move(pair.matches), .num_putative = count});
  }
  return pairs;
}

}  // namespace

absl::StatusOr<CorridorSize> WriteCorridor(const CorridorOptions& options,
                                           const std::string& folder) {
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(folder));
  Corridor corridor = MakeCorridor(options);
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(folder + "/truth.csv", TruthCsv(corridor)));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(folder + "/gnss.csv", GnssCsv(corridor.manifest)));
  const std::vector<TwoViewGeometry> pairs = VerifiedPairs(corridor);
  ORBWEAVE_RETURN_IF_ERROR(
      WriteColmapDatabase(folder + "/corridor.db", corridor.manifest, corridor.features, pairs));
  return CorridorSize{corridor.features.size(), pairs.size()};
}

}  // namespace orbweave
