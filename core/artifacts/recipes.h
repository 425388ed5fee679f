// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/digest.h"
#include "core/scene/carrier.h"
#include "core/scene/ids.h"
#include "core/scene/predicted_pose.h"

/// A recipe names everything one part of a stage reads, by digest: it is the whole input of a task,
/// so its own digest names the task, and an unchanged part of a changed job is not computed again.

namespace orbweave {

struct ExtractRecipe {
  Digest image{};
  Digest mask{};  ///< zero: none
  bool mask_ignores_white = true;
  bool wants_facades = false;  ///< features of facade views too
};

/// What is needed to recognise a place, without opening its Features.
struct PlaceSample {
  uint32_t num_features = 0;
  std::vector<uint8_t> descriptors{};  ///< n x kDescriptorSize
  std::string problem{};               ///< of the Features
};

/// The Features blob of an image.
struct FeatureFile {
  ImageId image{};
  Digest features{};
};

struct MatchRecipe {
  struct Pair {
    ImagePair pair{};
    /// Putative matches given from outside (a database); empty: match descriptors.
    std::vector<FeatureMatch> matches{};
    std::optional<PredictedPose> predicted{};  ///< the pair is matched again, under this rotation
  };
  std::vector<FeatureFile> images{};  ///< of all images in `pairs`, sorted
  std::vector<Pair> pairs{};          ///< sorted
  std::vector<Carrier> carriers{};    ///< of these images; what is in their cells is not matched
};

/// Where GNSS and its drive have an image (PositionsByMotion), in the job's local frame.
struct PositionFix {
  ImageId image{};
  Eigen::Vector3d position_in_enu = Eigen::Vector3d::Zero();
  double horizontal_sigma_m = 1.0;
  double vertical_sigma_m = 1.0;
  bool is_of_drive = false;  ///< not of one measurement alone
  friend bool operator==(const PositionFix&, const PositionFix&) = default;
};

struct ClusterRecipe {
  uint32_t cluster = 0;
  std::vector<FeatureFile> images{};  ///< sorted
  std::vector<uint32_t> drives{};     ///< of each of the images
  /// Of each among those of its drive (ClusterImage::rank_in_drive).
  std::vector<uint32_t> ranks{};
  std::vector<ImagePair> pairs{};    ///< edges within the cluster, sorted
  std::vector<ImageId> shared{};     ///< images that other clusters have too, sorted
  std::vector<Digest> matches{};     ///< blobs that hold the geometry of these pairs, among others
  std::vector<PositionFix> fixes{};  ///< of the images that have one, sorted
};

}  // namespace orbweave
