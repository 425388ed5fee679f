// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/read_colmap_database.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/byte_stream.h"
#include "core/io/colmap/check_colmap_rows.h"
#include "core/io/colmap/read_colmap_pairs.h"
#include "core/io/colmap/read_colmap_priors.h"
#include "core/io/natural_order.h"
#include "core/io/printable_text.h"
#include "core/io/sqlite_connection.h"

namespace orbweave {
namespace {

constexpr int64_t kEquirectangularId = 17;
constexpr int64_t kSphereId = 11;
constexpr int64_t kMaxSidePx = 1 << 20;
constexpr int64_t kMaxNumImages = 2147483647;  ///< of COLMAP's pair ids

/// COLMAP's names by model id, for messages.
constexpr std::array<const char*, 18> kCameraModels = {"SIMPLE_PINHOLE",
                                                       "PINHOLE",
                                                       "SIMPLE_RADIAL",
                                                       "RADIAL",
                                                       "OPENCV",
                                                       "OPENCV_FISHEYE",
                                                       "FULL_OPENCV",
                                                       "FOV",
                                                       "SIMPLE_RADIAL_FISHEYE",
                                                       "RADIAL_FISHEYE",
                                                       "THIN_PRISM_FISHEYE",
                                                       "SPHERE",
                                                       "model 12",
                                                       "model 13",
                                                       "model 14",
                                                       "model 15",
                                                       "model 16",
                                                       "EQUIRECTANGULAR"};

/// Damaged content of a row: `where` names table and row.
absl::Status Damaged(const std::string& path, const std::string& where) {
  return absl::InvalidArgumentError(absl::StrCat(path, ": ", where, " is damaged"));
}

absl::StatusOr<std::map<int64_t, EquirectangularCamera>> ReadCameras(
    const SqliteConnection& database, const std::string& path) {
  std::map<int64_t, EquirectangularCamera> cameras;
  ORBWEAVE_ASSIGN_OR_RETURN(
      SqliteStatement rows,
      database.Prepare("SELECT camera_id, model, width, height FROM cameras WHERE camera_id IN "
                       "(SELECT camera_id FROM images) ORDER BY camera_id"));
  while (true) {
    ORBWEAVE_ASSIGN_OR_RETURN(const bool more, rows.Step());
    if (!more) return cameras;
    const int64_t id = rows.Integer(0);
    const int64_t model = rows.Integer(1);
    const int64_t width = rows.Integer(2);
    const int64_t height = rows.Integer(3);
    if (model != kEquirectangularId && model != kSphereId) {
      const bool named = model >= 0 && model < static_cast<int64_t>(kCameraModels.size());
      return absl::InvalidArgumentError(absl::StrCat(
          path,
          ": camera ",
          id,
          " is ",
          named ? kCameraModels[static_cast<size_t>(model)] : absl::StrCat("model ", model).c_str(),
          "; only panoramas can be used, EQUIRECTANGULAR (17) or SPHERE (11)"));
    }
    if (width <= 0 || height <= 0 || width > kMaxSidePx || std::abs(width - 2 * height) > 1) {
      return absl::InvalidArgumentError(
          absl::StrCat(path, ": camera ", id, " is ", width, "x", height, ", not 2:1"));
    }
    cameras[id] = {static_cast<int>(width), static_cast<int>(height)};
  }
}

/// An image_id that pair ids can hold.
absl::StatusOr<uint32_t> ImageIdOf(int64_t id, const std::string& path) {
  if (id >= 0 && id < kMaxNumImages) return static_cast<uint32_t>(id);
  return absl::InvalidArgumentError(absl::StrCat(
      path, ": an image has the number ", id, ", which is not between 0 and ", kMaxNumImages - 1));
}

/// Images in natural name order.
absl::Status ReadImages(const SqliteConnection& connection,
                        const std::string& path,
                        ColmapDatabase& database) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto cameras, ReadCameras(connection, path));
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement rows,
                            connection.Prepare("SELECT image_id, name, camera_id FROM images"));
  while (true) {
    ORBWEAVE_ASSIGN_OR_RETURN(const bool more, rows.Step());
    if (!more) break;
    DatabaseImage& image = database.images.emplace_back();
    ORBWEAVE_ASSIGN_OR_RETURN(image.database_id, ImageIdOf(rows.Integer(0), path));
    image.name = rows.Text(1);
    if (Utf8Text(image.name) != image.name) {
      return absl::InvalidArgumentError(
          absl::StrCat(path, ": the name of image ", image.database_id, " is not UTF-8"));
    }
    const auto camera = cameras.find(rows.Integer(2));
    if (camera == cameras.end()) {
      return absl::InvalidArgumentError(absl::StrCat(
          path, ": image ", image.name, " has camera ", rows.Integer(2), ", which does not exist"));
    }
    image.camera = camera->second;
  }
  if (database.images.empty())
    return absl::FailedPreconditionError(absl::StrCat(path, ": the database has no images"));
  std::sort(
      database.images.begin(),
      database.images.end(),
      [](const DatabaseImage& a, const DatabaseImage& b) { return NaturalLess(a.name, b.name); });
  return CheckColmapImages(database, path);
}

/// One keypoint of 2 (x, y), 4 (and scale, orientation) or 6 columns (and an affine shape).
Keypoint KeypointFromColumns(const std::array<float, 6>& v, int64_t columns) {
  Keypoint keypoint{v[0], v[1], 1.0F, 0.0F};
  if (columns == 4) {
    keypoint.scale_px = v[2];
    keypoint.orientation_rad = v[3];
  } else if (columns == 6) {  // a11 a12 a21 a22 = scale * rotation * shear
    keypoint.scale_px = 0.5F * (std::hypot(v[2], v[4]) + std::hypot(v[3], v[5]));
    keypoint.orientation_rad = std::atan2(v[4], v[2]);
  }
  return keypoint;
}

absl::Status ReadKeypoints(const SqliteConnection& connection,
                           const std::string& path,
                           ColmapDatabase& database) {
  const std::map<int64_t, ImageId> ids = ImageIdsByDatabaseId(database);
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement rows,
                            connection.Prepare("SELECT image_id, rows, cols, data FROM keypoints"));
  while (true) {
    ORBWEAVE_ASSIGN_OR_RETURN(const bool more, rows.Step());
    if (!more) return absl::OkStatus();
    const auto id = ids.find(rows.Integer(0));
    if (id == ids.end()) continue;
    DatabaseImage& image = database.images[id->second.value];
    const int64_t count = rows.Integer(1);
    const int64_t columns = rows.Integer(2);
    const std::string_view data = rows.Blob(3);
    const bool known = columns == 2 || columns == 4 || columns == 6;
    if ((count > 0 && !known) || !IsTable(data, count, columns, sizeof(float))) {
      return Damaged(path, "the keypoints row of " + image.name);
    }
    if (!image.keypoints.empty())
      return absl::InvalidArgumentError(
          absl::StrCat(path, ": the keypoints of ", image.name, " are there twice"));
    ByteReader in(data);
    image.keypoints.reserve(static_cast<size_t>(count));
    for (int64_t i = 0; i < count; ++i) {
      std::array<float, 6> values{};
      for (int64_t c = 0; c < columns; ++c) values[static_cast<size_t>(c)] = in.Take<float>();
      if (!std::isfinite(values[0]) || !std::isfinite(values[1]))
        return Damaged(path, "the keypoints row of " + image.name);
      image.keypoints.push_back(KeypointFromColumns(values, columns));
    }
    ORBWEAVE_RETURN_IF_ERROR(CheckColmapKeypoints(image, path));
  }
}

}  // namespace

absl::StatusOr<ColmapDatabase> ReadColmapDatabase(const std::string& path) {
  ORBWEAVE_ASSIGN_OR_RETURN(const SqliteConnection connection, SqliteConnection::OpenToRead(path));
  ColmapDatabase database;
  ORBWEAVE_RETURN_IF_ERROR(ReadImages(connection, path, database));
  ORBWEAVE_RETURN_IF_ERROR(ReadKeypoints(connection, path, database));
  ORBWEAVE_RETURN_IF_ERROR(ReadColmapPriors(connection, database));
  ORBWEAVE_RETURN_IF_ERROR(ReadColmapPairs(connection, path, "two_view_geometries", database));
  if (database.pairs.empty()) {
    database.matches_are_verified = false;
    ORBWEAVE_RETURN_IF_ERROR(ReadColmapPairs(connection, path, "matches", database));
  }
  if (database.pairs.empty()) {
    return absl::FailedPreconditionError(
        absl::StrCat(path,
                     ": the database has no matches; run a matcher first (colmap "
                     "sequential_matcher or spatial_matcher)"));
  }
  return database;
}

ImageSources SourcesFromDatabase(const ColmapDatabase& database) {
  ImageSources sources;
  sources.warnings = database.warnings;
  for (const DatabaseImage& image : database.images) {
    SourceImage& source = sources.images.emplace_back();
    source.name = image.name;
    source.metadata.width_px = image.camera.width_px;
    source.metadata.height_px = image.camera.height_px;
    source.metadata.position = image.prior.geodetic;
    source.metadata.altitude_known =
        image.prior.geodetic && std::isfinite(image.prior.geodetic->altitude_m);
    source.position_in_local = image.prior.position_in_enu;
    if (image.prior_sigma_known) {
      source.position_sigma_m =
          Eigen::Vector2d(image.prior.horizontal_sigma_m, image.prior.vertical_sigma_m);
    }
  }
  return sources;
}

}  // namespace orbweave
