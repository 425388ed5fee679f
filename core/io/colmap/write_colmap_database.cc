// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/write_colmap_database.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/geometry/rotation.h"
#include "core/io/byte_stream.h"
#include "core/io/colmap/colmap_pair_id.h"
#include "core/io/file.h"
#include "core/io/sqlite_connection.h"

namespace orbweave {
namespace {

/// Tables of COLMAP 4.x. Columns that only 3.8 has (prior_q*, prior_t* of images) stay NULL; later
/// versions name the columns they want and do not see them.
constexpr char kSchema[] = R"sql(
PRAGMA journal_mode = OFF;
PRAGMA synchronous = OFF;
PRAGMA user_version = 3900;
CREATE TABLE rigs (rig_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, ref_sensor_id INTEGER NOT NULL,
  ref_sensor_type INTEGER NOT NULL);
CREATE UNIQUE INDEX rig_ref_sensor_assignment ON rigs(ref_sensor_id, ref_sensor_type);
CREATE TABLE rig_sensors (rig_id INTEGER NOT NULL, sensor_id INTEGER NOT NULL, sensor_type INTEGER NOT NULL,
  sensor_from_rig BLOB, FOREIGN KEY(rig_id) REFERENCES rigs(rig_id) ON DELETE CASCADE);
CREATE UNIQUE INDEX rig_sensor_assignment ON rig_sensors(sensor_id, sensor_type);
CREATE TABLE cameras (camera_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, model INTEGER NOT NULL,
  width INTEGER NOT NULL, height INTEGER NOT NULL, params BLOB, prior_focal_length INTEGER NOT NULL);
CREATE TABLE frames (frame_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, rig_id INTEGER NOT NULL,
  FOREIGN KEY(rig_id) REFERENCES rigs(rig_id) ON DELETE CASCADE);
CREATE TABLE frame_data (frame_id INTEGER NOT NULL, data_id INTEGER NOT NULL, sensor_id INTEGER NOT NULL,
  sensor_type INTEGER NOT NULL, FOREIGN KEY(frame_id) REFERENCES frames(frame_id) ON DELETE CASCADE);
CREATE UNIQUE INDEX frame_sensor_assignment ON frame_data(data_id, sensor_type);
CREATE TABLE images (image_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, name TEXT NOT NULL UNIQUE,
  camera_id INTEGER NOT NULL, prior_qw REAL, prior_qx REAL, prior_qy REAL, prior_qz REAL,
  prior_tx REAL, prior_ty REAL, prior_tz REAL,
  CONSTRAINT image_id_check CHECK(image_id >= 0 and image_id < 2147483647),
  FOREIGN KEY(camera_id) REFERENCES cameras(camera_id));
CREATE UNIQUE INDEX index_name ON images(name);
CREATE TABLE pose_priors (pose_prior_id INTEGER PRIMARY KEY NOT NULL, corr_data_id INTEGER NOT NULL,
  corr_sensor_id INTEGER NOT NULL, corr_sensor_type INTEGER NOT NULL, position BLOB, position_covariance BLOB,
  gravity BLOB, coordinate_system INTEGER NOT NULL);
CREATE UNIQUE INDEX pose_prior_data_assignment ON pose_priors(corr_data_id, corr_sensor_id, corr_sensor_type);
CREATE TABLE keypoints (image_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL,
  data BLOB, FOREIGN KEY(image_id) REFERENCES images(image_id) ON DELETE CASCADE);
CREATE TABLE descriptors (image_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL,
  data BLOB, type INTEGER NOT NULL DEFAULT 0, FOREIGN KEY(image_id) REFERENCES images(image_id) ON DELETE CASCADE);
CREATE TABLE matches (pair_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL, data BLOB);
CREATE TABLE two_view_geometries (pair_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL, cols INTEGER NOT NULL,
  data BLOB, config INTEGER NOT NULL, F BLOB, E BLOB, H BLOB, qvec BLOB, tvec BLOB);
)sql";

constexpr int64_t kCameraSensor = 0;
constexpr int64_t kDescriptorColumns = 128;

int64_t DatabaseId(ImageId id) { return static_cast<int64_t>(id.value) + 1; }

template <typename... Numbers>
std::string BlobOf(Numbers... numbers) {
  ByteWriter out;
  (out.Put<double>(numbers), ...);
  return out.Take();
}

/// Camera id by width and height.
using CameraIds = std::map<std::pair<int, int>, int64_t>;

/// One camera and one rig of that camera per image size; returns the camera id per size.
absl::StatusOr<CameraIds> WriteCameras(const SqliteConnection& connection,
                                       const ImageManifest& manifest,
                                       DatabaseCameraModel model) {
  CameraIds ids;
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement camera,
                            connection.Prepare("INSERT INTO cameras VALUES(?, ?, ?, ?, ?, 1)"));
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement rig,
                            connection.Prepare("INSERT INTO rigs VALUES(?, ?, ?)"));
  const bool sphere = model == DatabaseCameraModel::kSphere;
  for (const ImageRecord& image : manifest.images) {
    const auto [width, height] = image.camera;
    const int64_t id = static_cast<int64_t>(ids.size()) + 1;
    if (!ids.emplace(std::pair(width, height), id).second) continue;
    const std::string params =
        sphere ? BlobOf(1.0, width / 2.0, height / 2.0) : BlobOf(width, height);
    camera.Bind(1, id);
    camera.Bind(2, int64_t{sphere ? 11 : 17});
    camera.Bind(3, int64_t{width});
    camera.Bind(4, int64_t{height});
    camera.BindBlob(5, params);
    ORBWEAVE_RETURN_IF_ERROR(camera.Run());
    rig.Bind(1, id);
    rig.Bind(2, id);
    rig.Bind(3, kCameraSensor);
    ORBWEAVE_RETURN_IF_ERROR(rig.Run());
  }
  return ids;
}

/// Positions of images that have one: WGS84 where known, else Cartesian.
absl::Status WritePriors(const SqliteConnection& connection,
                         const ImageManifest& manifest,
                         const CameraIds& camera_ids) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      SqliteStatement prior,
      connection.Prepare(
          "INSERT INTO pose_priors(pose_prior_id, corr_data_id, corr_sensor_id, corr_sensor_type, "
          "position, position_covariance, coordinate_system) VALUES(?, ?, ?, ?, ?, ?, ?)"));
  for (const ImageRecord& record : manifest.images) {
    if (!record.prior.geodetic && !record.prior.position_in_enu) continue;
    const bool geodetic = record.prior.geodetic.has_value();
    const GeodeticPosition at = record.prior.geodetic.value_or(GeodeticPosition{});
    const Eigen::Vector3d local = record.prior.position_in_enu.value_or(Eigen::Vector3d(0, 0, 0));
    const std::string position = geodetic ? BlobOf(at.latitude_deg, at.longitude_deg, at.altitude_m)
                                          : BlobOf(local.x(), local.y(), local.z());
    const double h = record.prior.horizontal_sigma_m * record.prior.horizontal_sigma_m;
    const double v = record.prior.vertical_sigma_m * record.prior.vertical_sigma_m;
    const std::string covariance = BlobOf(h, 0.0, 0.0, 0.0, h, 0.0, 0.0, 0.0, v);
    prior.Bind(1, DatabaseId(record.id));
    prior.Bind(2, DatabaseId(record.id));
    prior.Bind(3, camera_ids.at({record.camera.width_px, record.camera.height_px}));
    prior.Bind(4, kCameraSensor);
    prior.BindBlob(5, position);
    prior.BindBlob(6, covariance);
    prior.Bind(7, int64_t{geodetic ? 0 : 1});
    ORBWEAVE_RETURN_IF_ERROR(prior.Run());
  }
  return absl::OkStatus();
}

absl::Status WriteImages(const SqliteConnection& connection,
                         const ImageManifest& manifest,
                         DatabaseCameraModel model) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto camera_ids, WriteCameras(connection, manifest, model));
  ORBWEAVE_ASSIGN_OR_RETURN(
      SqliteStatement image,
      connection.Prepare("INSERT INTO images(image_id, name, camera_id) VALUES(?, ?, ?)"));
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement frame,
                            connection.Prepare("INSERT INTO frames VALUES(?, ?)"));
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement data,
                            connection.Prepare("INSERT INTO frame_data VALUES(?, ?, ?, ?)"));
  for (const ImageRecord& record : manifest.images) {
    const int64_t id = DatabaseId(record.id);
    const int64_t camera_id = camera_ids.at({record.camera.width_px, record.camera.height_px});
    image.Bind(1, id);
    image.Bind(2, std::string_view(record.name));
    image.Bind(3, camera_id);
    ORBWEAVE_RETURN_IF_ERROR(image.Run());
    frame.Bind(1, id);
    frame.Bind(2, camera_id);
    ORBWEAVE_RETURN_IF_ERROR(frame.Run());
    data.Bind(1, id);
    data.Bind(2, id);
    data.Bind(3, camera_id);
    data.Bind(4, kCameraSensor);
    ORBWEAVE_RETURN_IF_ERROR(data.Run());
  }
  return WritePriors(connection, manifest, camera_ids);
}

absl::Status WriteFeatures(const SqliteConnection& connection,
                           const std::vector<Features>& features) {
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement keypoints,
                            connection.Prepare("INSERT INTO keypoints VALUES(?, ?, 4, ?)"));
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement descriptors,
                            connection.Prepare("INSERT INTO descriptors VALUES(?, ?, ?, ?, 0)"));
  for (size_t i = 0; i < features.size(); ++i) {
    const int64_t id = static_cast<int64_t>(i) + 1;
    const int64_t count = static_cast<int64_t>(features[i].size());
    ByteWriter out;
    for (const Keypoint& k : features[i].keypoints)
      out.Put(k.x_px).Put(k.y_px).Put(k.scale_px).Put(k.orientation_rad);
    const std::string data = out.Take();
    keypoints.Bind(1, id);
    keypoints.Bind(2, count);
    keypoints.BindBlob(3, data);
    ORBWEAVE_RETURN_IF_ERROR(keypoints.Run());
    if (features[i].descriptors.empty()) continue;
    const std::vector<uint8_t>& bytes = features[i].descriptors;
    descriptors.Bind(1, id);
    descriptors.Bind(2, count);
    descriptors.Bind(3, kDescriptorColumns);
    descriptors.BindBlob(4, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    ORBWEAVE_RETURN_IF_ERROR(descriptors.Run());
  }
  return absl::OkStatus();
}

/// COLMAP's TwoViewGeometry::ConfigurationType: 1 degenerate, 2 calibrated, 4 planar, 5 panoramic.
int64_t ConfigOf(TwoViewKind kind) {
  switch (kind) {
    case TwoViewKind::kGeneral:
      return 2;
    case TwoViewKind::kPlanar:
      return 4;
    case TwoViewKind::kPureRotation:
      return 5;
    case TwoViewKind::kNone:
      break;
  }
  return 1;
}

absl::Status WritePairs(const SqliteConnection& connection,
                        const std::vector<TwoViewGeometry>& pairs) {
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement matches,
                            connection.Prepare("INSERT INTO matches VALUES(?, ?, 2, ?)"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      SqliteStatement geometry,
      connection.Prepare(
          "INSERT INTO two_view_geometries VALUES(?, ?, 2, ?, ?, NULL, ?, NULL, ?, ?)"));
  for (const TwoViewGeometry& pair : pairs) {
    const int64_t pair_id =
        static_cast<int64_t>(PairIdFromImageIds(pair.pair.a.value + 1, pair.pair.b.value + 1));
    const int64_t count = static_cast<int64_t>(pair.inliers.size());
    ByteWriter out;
    for (const FeatureMatch& match : pair.inliers)
      out.Put<uint32_t>(match.a).Put<uint32_t>(match.b);
    const std::string data = out.Take();
    for (SqliteStatement* statement : {&matches, &geometry}) {
      statement->Bind(1, pair_id);
      statement->Bind(2, count);
      statement->BindBlob(3, data);
    }
    ORBWEAVE_RETURN_IF_ERROR(matches.Run());
    const Eigen::Quaterniond& q = pair.b_from_a.rotation;
    const Eigen::Vector3d& t = pair.b_from_a.translation;
    const Eigen::Matrix3d E = SkewSymmetric(t) * q.toRotationMatrix();
    const std::string essential =
        BlobOf(E(0, 0), E(0, 1), E(0, 2), E(1, 0), E(1, 1), E(1, 2), E(2, 0), E(2, 1), E(2, 2));
    const std::string qvec = BlobOf(q.w(), q.x(), q.y(), q.z());
    const std::string tvec = BlobOf(t.x(), t.y(), t.z());
    geometry.Bind(4, ConfigOf(pair.kind));
    geometry.BindBlob(5, essential);
    geometry.BindBlob(6, qvec);
    geometry.BindBlob(7, tvec);
    ORBWEAVE_RETURN_IF_ERROR(geometry.Run());
  }
  return absl::OkStatus();
}

absl::Status WriteTables(const std::string& path,
                         const ImageManifest& manifest,
                         const std::vector<Features>& features,
                         const std::vector<TwoViewGeometry>& pairs,
                         DatabaseCameraModel model) {
  ORBWEAVE_ASSIGN_OR_RETURN(const SqliteConnection connection, SqliteConnection::OpenToWrite(path));
  ORBWEAVE_RETURN_IF_ERROR(connection.Execute(kSchema));
  ORBWEAVE_RETURN_IF_ERROR(connection.Execute("BEGIN"));
  ORBWEAVE_RETURN_IF_ERROR(WriteImages(connection, manifest, model));
  ORBWEAVE_RETURN_IF_ERROR(WriteFeatures(connection, features));
  ORBWEAVE_RETURN_IF_ERROR(WritePairs(connection, pairs));
  return connection.Execute("COMMIT");
}

}  // namespace

absl::Status WriteColmapDatabase(const std::string& path,
                                 const ImageManifest& manifest,
                                 const std::vector<Features>& features,
                                 const std::vector<TwoViewGeometry>& pairs,
                                 DatabaseCameraModel model) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(folder.empty() ? "." : folder));
  const std::string temporary = absl::StrCat(path, ".tmp", ::getpid());
  std::remove(temporary.c_str());
  absl::Status status = WriteTables(temporary, manifest, features, pairs, model);
  if (status.ok() && std::rename(temporary.c_str(), path.c_str()) != 0) {
    status = absl::UnavailableError(absl::StrCat("cannot rename ", temporary, " to ", path));
  }
  if (!status.ok()) std::remove(temporary.c_str());
  return status;
}

}  // namespace orbweave
