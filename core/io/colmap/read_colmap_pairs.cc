// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/read_colmap_pairs.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/colmap/check_colmap_rows.h"
#include "core/io/colmap/colmap_pair_id.h"

namespace orbweave {
namespace {

constexpr int64_t kMaxNumImages = 2147483647;  ///< of COLMAP's pair ids

/// COLMAP's TwoViewGeometry::ConfigurationType, as far as it comes with a pose.
enum TwoViewConfig : int64_t { kCalibrated = 2, kPlanar = 4, kPanoramic = 5 };

/// Turns a geometry of (x, y) into one of (y, x).
TwoViewGeometry Exchanged(TwoViewGeometry geometry) {
  geometry.b_from_a = geometry.b_from_a.Inverse();
  for (FeatureMatch& match : geometry.inliers) std::swap(match.a, match.b);
  return geometry;
}

/// Kind and pose where the row has them. COLMAP writes the identity when it computed no relative
/// pose.
void SetPose(int64_t config,
             std::string_view qvec,
             std::string_view tvec,
             TwoViewGeometry& geometry) {
  const auto q = NumbersFromBlob<4>(qvec);
  const auto t = NumbersFromBlob<3>(tvec);
  if (!q || !t) return;
  const Eigen::Quaterniond rotation((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
  const Eigen::Vector3d translation((*t)[0], (*t)[1], (*t)[2]);
  if (std::abs(rotation.norm() - 1.0) > 1e-3) return;
  const bool moved = translation.norm() > 1e-12;
  if (config == kPanoramic) {
    geometry.kind = TwoViewKind::kPureRotation;
  } else if (moved && (config == kCalibrated || config == kPlanar)) {
    geometry.kind = config == kPlanar ? TwoViewKind::kPlanar : TwoViewKind::kGeneral;
    geometry.b_from_a.translation = translation.normalized();
  } else {
    return;
  }
  geometry.b_from_a.rotation = rotation.normalized();
}

absl::Status ReadMatches(std::string_view data,
                         int64_t count,
                         size_t num_a,
                         size_t num_b,
                         std::vector<FeatureMatch>& matches) {
  if (!IsTable(data, count, 2, sizeof(uint32_t))) return absl::InvalidArgumentError("is damaged");
  ByteReader in(data);
  matches.reserve(static_cast<size_t>(count));
  for (int64_t i = 0; i < count; ++i) {
    const uint32_t a = in.Take<uint32_t>();
    const uint32_t b = in.Take<uint32_t>();
    if (a >= num_a || b >= num_b) {
      return absl::InvalidArgumentError(
          absl::StrCat("matches keypoint ", a, " of ", num_a, " with ", b, " of ", num_b));
    }
    matches.push_back({a, b});
  }
  return absl::OkStatus();
}

/// One row of (pair_id, rows, data, config, qvec, tvec).
absl::StatusOr<TwoViewGeometry> PairFromRow(const SqliteStatement& row,
                                            const std::string& where,
                                            const std::map<int64_t, ImageId>& ids,
                                            const ColmapDatabase& database) {
  const int64_t pair_id = row.Integer(0);
  if (pair_id < 0 || pair_id / kMaxNumImages >= kMaxNumImages) {
    return absl::InvalidArgumentError(
        absl::StrCat(where, ": the pair id ", pair_id, " names no two images"));
  }
  const auto [x, y] = ImageIdsFromPairId(static_cast<uint64_t>(pair_id));
  const auto id_x = ids.find(x);
  const auto id_y = ids.find(y);
  if (id_x == ids.end() || id_y == ids.end() || x == y) {
    return absl::InvalidArgumentError(
        absl::StrCat(where, ": a row joins images ", x, " and ", y, ", which do not exist"));
  }
  const DatabaseImage& image_x = database.images[id_x->second.value];
  const DatabaseImage& image_y = database.images[id_y->second.value];
  TwoViewGeometry geometry;
  const absl::Status status = ReadMatches(row.Blob(2),
                                          row.Integer(1),
                                          image_x.keypoints.size(),
                                          image_y.keypoints.size(),
                                          geometry.inliers);
  if (!status.ok())
    return Annotate(status,
                    absl::StrCat(where, ": the row of ", image_x.name, " and ", image_y.name));
  SetPose(row.Integer(3), row.Blob(4), row.Blob(5), geometry);
  if (id_y->second < id_x->second) geometry = Exchanged(std::move(geometry));
  geometry.pair = MakePair(id_x->second, id_y->second);
  geometry.num_putative = static_cast<uint32_t>(geometry.inliers.size());
  std::sort(geometry.inliers.begin(), geometry.inliers.end());
  return geometry;
}

}  // namespace

/// Our id of each image_id.
std::map<int64_t, ImageId> ImageIdsByDatabaseId(const ColmapDatabase& database) {
  std::map<int64_t, ImageId> ids;
  for (size_t i = 0; i < database.images.size(); ++i)
    ids[database.images[i].database_id] = ImageId(static_cast<uint32_t>(i));
  return ids;
}

absl::Status ReadColmapPairs(const SqliteConnection& connection,
                             const std::string& path,
                             const std::string& table,
                             ColmapDatabase& database) {
  ORBWEAVE_ASSIGN_OR_RETURN(const bool present, connection.HasTable(table));
  if (!present) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const bool poses, connection.HasColumn(table, "qvec"));
  ORBWEAVE_ASSIGN_OR_RETURN(const bool config, connection.HasColumn(table, "config"));
  const std::string sql = absl::StrCat("SELECT pair_id, rows, data, ",
                                       config ? "config" : "0",
                                       ", ",
                                       poses ? "qvec, tvec" : "NULL, NULL",
                                       " FROM ",
                                       table,
                                       " WHERE rows > 0");
  const std::map<int64_t, ImageId> ids = ImageIdsByDatabaseId(database);
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement rows, connection.Prepare(sql));
  while (true) {
    ORBWEAVE_ASSIGN_OR_RETURN(const bool more, rows.Step());
    if (!more) break;
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry,
                              PairFromRow(rows, path + ": table " + table, ids, database));
    database.pairs.push_back(std::move(geometry));
  }
  std::sort(database.pairs.begin(),
            database.pairs.end(),
            [](const TwoViewGeometry& a, const TwoViewGeometry& b) { return a.pair < b.pair; });
  return CheckColmapPairs(database, path + ": table " + table);
}

}  // namespace orbweave
