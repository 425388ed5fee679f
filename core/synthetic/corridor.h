// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/options.h"
#include "core/geometry/rigid3.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

enum class CorridorShape { kStraight, kBends, kLoop, kGrid };

template <>
struct EnumNames<CorridorShape> {
  static constexpr std::array<std::pair<CorridorShape, std::string_view>, 4> kNames = {
      {{CorridorShape::kStraight, "straight"},
       {CorridorShape::kBends, "bends"},
       {CorridorShape::kLoop, "loop"},
       {CorridorShape::kGrid, "grid"}}};
};

/// A street as rays alone, for scale: no pixels are rendered.
struct CorridorOptions {
  int panoramas = 100;
  CorridorShape shape = CorridorShape::kBends;
  double spacing_m = 3.0;
  int features_per_panorama = 731;
  int width_px = 5400;
  double noise_px = 0.5;
  double outlier_share = 0.02;
  double gnss_sigma_m = 2.0;
  double gnss_outlier_share = 0.0;
  bool random_rotations = false;
  bool descriptors = false;
  int match_window = 8;
  int seed = 1;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("panoramas", self.panoramas, "number of panoramas", Range{1, 1000000});
    visit("shape",
          self.shape,
          "straight; bends; loop: the end meets the start; grid: streets that cross");
    visit("spacing_m", self.spacing_m, "distance between panoramas", Range{0.01, 1000});
    visit("features_per_panorama",
          self.features_per_panorama,
          "features per panorama, on average",
          Range{10, 20000});
    visit("width_px",
          self.width_px,
          "width of the panoramas that the noise refers to",
          Range{64, 65536});
    visit("noise_px",
          self.noise_px,
          "standard deviation of a bearing per axis, pixels at the equator",
          Range{0, 100});
    visit(
        "outlier_share", self.outlier_share, "share of wrong matches in each pair", Range{0, 0.95});
    visit("gnss_sigma_m",
          self.gnss_sigma_m,
          "horizontal GNSS noise; twice as much vertically; 0: no GNSS",
          Range{0, 1000});
    visit("gnss_outlier_share",
          self.gnss_outlier_share,
          "share of GNSS positions that are 20 to 100 m off",
          Range{0, 1});
    visit(
        "random_rotations", self.random_rotations, "turn every panorama by a rotation of its own");
    visit("descriptors", self.descriptors, "give features descriptors that tell points apart");
    visit("match_window",
          self.match_window,
          "following panoramas each one is matched with",
          Range{1, 1000});
    visit("seed", self.seed, "another seed, another street", Range{0, 2147483647});
  }
};

/// Matches of a pair as a matcher would find them, wrong ones among them; sorted.
struct PairMatches {
  ImagePair pair{};
  std::vector<FeatureMatch> matches{};
};

struct Corridor {
  ImageManifest manifest{};
  std::vector<Features> features{};  ///< by image
  std::vector<PairMatches> pairs{};  ///< sorted by pair
  std::vector<Rigid3>
      cams_from_world{};  ///< truth; world is east-north-up metres at the manifest's origin
  std::vector<Eigen::Vector3d> points_in_world{};
  std::vector<std::vector<uint32_t>>
      point_of_feature{};  ///< by image and feature: index into points_in_world
};

/// A street of facades, ground and clutter seen by equally spaced panoramas. A point is seen by the
/// panoramas within its own range (tracks of about six), with drop-out. Noise is isotropic in the
/// tangent plane of the bearing, so that seam and poles are nowhere special. Pairs: the next
/// `match_window` panoramas and those within 20 m where streets meet, when they share at least 15
/// points. Deterministic; time and memory grow linearly with the street.
[[nodiscard]] Corridor MakeCorridor(const CorridorOptions& options);

}  // namespace orbweave
