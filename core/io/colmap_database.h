// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/geometry/equirectangular_camera.h"
#include "core/io/image_sources.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

struct DatabaseImage {
  std::string name{};
  uint32_t database_id = 0;  ///< image_id in the file
  EquirectangularCamera camera{};
  std::vector<Keypoint> keypoints{};
  /// pose_priors: WGS84 in `geodetic`, Cartesian in `position_in_enu`; sigmas from the covariance
  /// when given. An altitude that cannot be is NaN.
  PosePrior prior{};
  bool prior_sigma_known = false;
};

/// Keypoints and matches from a COLMAP database, in our own ids.
struct ColmapDatabase {
  /// Natural name order: images[i] is ImageId i, whatever its id in the file.
  std::vector<DatabaseImage> images{};
  /// Sorted by pair. From two_view_geometries: `inliers`, kind and b_from_a where the file has them
  /// (kNone: it has matches but no pose). When that table is empty, the raw matches stand in
  /// `inliers`.
  std::vector<TwoViewGeometry> pairs{};
  bool matches_are_verified = true;     ///< false: `inliers` are raw matches
  std::vector<std::string> warnings{};  ///< what is left out
};

/// Reads a database of COLMAP 3.8 to 4.x or SphereSfM: cameras EQUIRECTANGULAR (17: w,h) and SPHERE
/// (11: f,cx,cy), keypoints of 2, 4 or 6 columns, verified matches, else raw ones, pose priors of
/// all layouts. NotFound: no such file. InvalidArgument: not a database, another camera model
/// ("camera 3 is PINHOLE; ..."), an image that is not 2:1, damaged rows, match indices out of
/// range, and what no database should hold (check_colmap_rows.h). Priors that cannot be are left
/// out with a warning. FailedPrecondition: no images, or no matches.
[[nodiscard]] absl::StatusOr<ColmapDatabase> ReadColmapDatabase(const std::string& path);

enum class DatabaseCameraModel {
  kEquirectangular,  ///< id 17, COLMAP 4.1 and later
  kSphere,           ///< id 11, SphereSfM
};

/// Writes the tables of COLMAP 4.x (a superset of those of 3.8: each image also is its own frame of
/// a one-camera rig), replacing `path`. image_id = ImageId + 1. `features` by ImageId; descriptors
/// are written where present. Codes of WriteFileAtomically.
[[nodiscard]] absl::Status WriteColmapDatabase(
    const std::string& path,
    const ImageManifest& manifest,
    const std::vector<Features>& features,
    const std::vector<TwoViewGeometry>& pairs,
    DatabaseCameraModel model = DatabaseCameraModel::kEquirectangular);

/// The images of a database as IngestImages takes them; images[i] stays image i (none can be
/// excluded).
[[nodiscard]] ImageSources SourcesFromDatabase(const ColmapDatabase& database);

/// COLMAP's number of an image pair: 2147483647 * a + b for image ids a < b; and back.
[[nodiscard]] uint64_t PairIdFromImageIds(uint32_t a, uint32_t b);
[[nodiscard]] std::pair<uint32_t, uint32_t> ImageIdsFromPairId(uint64_t pair_id);

}  // namespace orbweave
