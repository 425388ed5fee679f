// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/colmap/check_colmap_rows.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr size_t kLongestName = 4096;  ///< PATH_MAX
constexpr float kTolerance_px = 1.0F;
// An extractor may give several keypoints of one place, one for each of its orientations: two with
// COLMAP's defaults.
constexpr size_t kFewestAlike = 8;

absl::Status Refuse(const std::string& path, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(path, ": ", what));
}

}  // namespace

absl::Status CheckColmapImages(const ColmapDatabase& database, const std::string& path) {
  std::set<uint32_t> ids;
  std::map<std::string_view, uint32_t> id_of_name;
  for (const DatabaseImage& image : database.images) {
    const std::string id = absl::StrCat("image ", image.database_id);
    if (image.name.empty()) return Refuse(path, id + " has no name");
    if (image.name.size() > kLongestName) {
      return Refuse(path, absl::StrCat("the name of ", id, " has ", image.name.size(), " bytes"));
    }
    const auto [first, is_new] = id_of_name.emplace(image.name, image.database_id);
    if (!is_new) {
      return Refuse(path,
                    absl::StrCat("images ",
                                 first->second,
                                 " and ",
                                 image.database_id,
                                 " are both called ",
                                 image.name));
    }
    if (!ids.insert(image.database_id).second) return Refuse(path, id + " is there twice");
  }
  return absl::OkStatus();
}

absl::Status CheckColmapKeypoints(const DatabaseImage& image, const std::string& path) {
  const auto width = static_cast<float>(image.camera.width_px);
  const auto height = static_cast<float>(image.camera.height_px);
  const auto is_outside = [&](const Keypoint& k) {
    return !(k.x_px >= -kTolerance_px && k.x_px <= width + kTolerance_px &&
             k.y_px >= -kTolerance_px && k.y_px <= height + kTolerance_px);
  };
  const auto outside = std::ranges::find_if(image.keypoints, is_outside);
  if (outside != image.keypoints.end()) {
    return Refuse(path,
                  absl::StrCat("keypoint ",
                               outside - image.keypoints.begin(),
                               " of ",
                               image.name,
                               " is at (",
                               outside->x_px,
                               ", ",
                               outside->y_px,
                               "), outside of the image of ",
                               image.camera.width_px,
                               "x",
                               image.camera.height_px,
                               "; were they found in images of another size?"));
  }
  const auto is_like_first = [&](const Keypoint& k) {
    return k.x_px == image.keypoints.front().x_px && k.y_px == image.keypoints.front().y_px;
  };
  if (image.keypoints.size() < kFewestAlike || !std::ranges::all_of(image.keypoints, is_like_first))
    return absl::OkStatus();
  return Refuse(
      path,
      absl::StrCat(
          "the ", image.keypoints.size(), " keypoints of ", image.name, " are all at one place"));
}

absl::Status CheckColmapPairs(const ColmapDatabase& database, const std::string& where) {
  const auto twice = std::ranges::adjacent_find(database.pairs, {}, &TwoViewGeometry::pair);
  if (twice == database.pairs.end()) return absl::OkStatus();
  return Refuse(where,
                absl::StrCat("the pair of ",
                             database.images[twice->pair.a.value].name,
                             " and ",
                             database.images[twice->pair.b.value].name,
                             " is there twice"));
}

}  // namespace orbweave
