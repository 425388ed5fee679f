// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/colmap/read_colmap_priors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/colmap/read_colmap_pairs.h"
#include "core/io/first_names.h"
#include "core/io/plausible.h"

namespace orbweave {
namespace {

constexpr int64_t kWgs84 = 0;
constexpr int64_t kCartesian = 1;
constexpr size_t kNamesShown = 3;

/// What is left out, with the names of its images.
using Problems = std::map<std::string, std::vector<std::string>>;

/// Whether nothing is stated: NULL, or NaN throughout, as COLMAP writes then.
bool IsUnset(const SqliteStatement& rows, int column) {
  if (rows.IsNull(column)) return true;
  const std::string_view blob = rows.Blob(column);
  if (blob.empty() || blob.size() % sizeof(double) != 0) return false;
  ByteReader in(blob);
  for (size_t i = 0; i < blob.size() / sizeof(double); ++i) {
    if (!std::isnan(in.Take<double>())) return false;
  }
  return true;
}

void SetGeodetic(const std::array<double, 3>& position, DatabaseImage& image, Problems& problems) {
  if (std::abs(position[0]) > 90.0 || std::abs(position[1]) > 180.0 ||
      (position[0] == 0.0 && position[1] == 0.0)) {
    problems["a position that is nowhere, or 0/0,"].push_back(image.name);
    return;
  }
  image.prior.geodetic = GeodeticPosition{position[0], position[1], position[2]};
  if (IsPlausibleHeight(position[2])) return;
  image.prior.geodetic->altitude_m = std::numeric_limits<double>::quiet_NaN();
  problems["a height that cannot be"].push_back(image.name);
}

void SetPrior(const std::array<double, 3>& position,
              int64_t coordinate_system,
              DatabaseImage& image,
              Problems& problems) {
  if (coordinate_system == kWgs84) return SetGeodetic(position, image, problems);
  if (coordinate_system != kCartesian) {
    problems["a position in a coordinate system that is not known"].push_back(image.name);
    return;
  }
  for (const double coordinate : position) {
    if (IsPlausibleCoordinate(coordinate)) continue;
    problems["a position that is nowhere, or 0/0,"].push_back(image.name);
    return;
  }
  image.prior.position_in_enu = Eigen::Vector3d(position[0], position[1], position[2]);
}

void SetSigma(const std::optional<std::array<double, 9>>& covariance,
              DatabaseImage& image,
              Problems& problems) {
  if (!covariance || !((*covariance)[0] > 0.0) || !((*covariance)[4] > 0.0) ||
      !((*covariance)[8] > 0.0))
    return;
  const double horizontal_m = std::sqrt(0.5 * ((*covariance)[0] + (*covariance)[4]));
  const double vertical_m = std::sqrt((*covariance)[8]);
  if (horizontal_m > kLargestSigma_m) {
    image.prior.geodetic.reset();
    image.prior.position_in_enu.reset();
    problems["a position that is worse than 10 km"].push_back(image.name);
    return;
  }
  if (!IsPlausibleSigma(horizontal_m) || !IsPlausibleSigma(std::min(vertical_m, kLargestSigma_m))) {
    problems["a covariance that cannot be"].push_back(image.name);
    return;
  }
  image.prior.horizontal_sigma_m = horizontal_m;
  image.prior.vertical_sigma_m = vertical_m > kLargestSigma_m ? kUnknownHeightSigma_m : vertical_m;
  image.prior_sigma_known = true;
}

/// One image may stand at the origin of a local frame; several at exactly 0/0/0 stand nowhere.
void DropSharedZeros(ColmapDatabase& database, Problems& problems) {
  std::vector<DatabaseImage*> at_zero;
  for (DatabaseImage& image : database.images) {
    if (image.prior.position_in_enu && image.prior.position_in_enu->isZero(0.0))
      at_zero.push_back(&image);
  }
  if (at_zero.size() < 2) return;
  for (DatabaseImage* image : at_zero) {
    image->prior.position_in_enu.reset();
    problems["the position 0/0/0, which cannot be that of several images,"].push_back(image->name);
  }
}

}  // namespace

/// pose_priors came with COLMAP 3.9 (keyed by image_id), got a covariance in 3.11 and in 4.0 its
/// own key beside the data it belongs to (sensor type 0 is a camera).
absl::Status ReadColmapPriors(const SqliteConnection& connection, ColmapDatabase& database) {
  ORBWEAVE_ASSIGN_OR_RETURN(const bool present, connection.HasTable("pose_priors"));
  if (!present) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const bool own_key,
                            connection.HasColumn("pose_priors", "corr_data_id"));
  ORBWEAVE_ASSIGN_OR_RETURN(const bool has_covariance,
                            connection.HasColumn("pose_priors", "position_covariance"));
  const std::string sql = absl::StrCat("SELECT ",
                                       own_key ? "corr_data_id" : "image_id",
                                       ", position, coordinate_system, ",
                                       has_covariance ? "position_covariance" : "NULL",
                                       " FROM pose_priors",
                                       own_key ? " WHERE corr_sensor_type = 0" : "");
  const std::map<int64_t, ImageId> ids = ImageIdsByDatabaseId(database);
  Problems problems;
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement rows, connection.Prepare(sql));
  while (true) {
    ORBWEAVE_ASSIGN_OR_RETURN(const bool more, rows.Step());
    if (!more) break;
    const auto id = ids.find(rows.Integer(0));
    if (id == ids.end() || IsUnset(rows, 1)) continue;
    DatabaseImage& image = database.images[id->second.value];
    const auto position = NumbersFromBlob<3>(rows.Blob(1));
    if (!position) {
      problems["a position that is not three numbers"].push_back(image.name);
      continue;
    }
    const auto covariance = NumbersFromBlob<9>(rows.Blob(3));
    if (!covariance && !IsUnset(rows, 3))
      problems["a covariance that is not nine numbers"].push_back(image.name);
    SetPrior(*position, rows.Integer(2), image, problems);
    SetSigma(covariance, image, problems);
  }
  DropSharedZeros(database, problems);
  for (const auto& [problem, names] : problems) {
    database.warnings.push_back(absl::StrCat("pose_priors: ",
                                             problem,
                                             " is not used (",
                                             names.size(),
                                             names.size() == 1 ? " image: " : " images: ",
                                             FirstNames(names, kNamesShown),
                                             ")"));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
