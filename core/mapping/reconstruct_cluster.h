// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/bundle/adjust_bundle.h"
#include "core/estimators/estimate_absolute_pose.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

enum class MappingPreset { kOrbweave, kPaper };

template <>
struct EnumNames<MappingPreset> {
  static constexpr std::array<std::pair<MappingPreset, std::string_view>, 2> kNames = {
      {{MappingPreset::kOrbweave, "orbweave"}, {MappingPreset::kPaper, "paper"}}};
};

/// How a model is begun: image by image from a seed pair, or with all images at once from their
/// pairs (StartGlobally); auto: globally where the result proves good, else from a seed.
enum class MappingStart { kIncremental, kGlobal, kAuto };

template <>
struct EnumNames<MappingStart> {
  static constexpr std::array<std::pair<MappingStart, std::string_view>, 3> kNames = {
      {{MappingStart::kIncremental, "incremental"},
       {MappingStart::kGlobal, "global"},
       {MappingStart::kAuto, "auto"}}};
};

/// Incremental mapping of one cluster; the paper's section 4 with what has been learned since.
struct MappingOptions {
  MappingPreset preset = MappingPreset::kOrbweave;
  MappingStart start = MappingStart::kIncremental;
  int seed_min_inliers = 100;
  double seed_min_angle_deg = 16.0;
  int min_inliers = 20;
  double max_error_px = 4.0;
  double min_angle_deg = 1.5;
  int two_view_below = 2000;
  int local_window = 12;
  double global_growth = 0.1;
  int max_seeds = 8;
  int min_component_images = 3;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit(
        "preset",
        self.preset,
        "orbweave, or the paper's own workflow for comparisons: then two_view.solver=eight_point, "
        "bundle.residual=erp_px and others are the defaults of a command (to see all: orbweave "
        "options --set mapping.preset=paper); what is set by --set or --config counts");
    visit(
        "start",
        self.start,
        "incremental: from a seed pair; global: all images at once; auto: globally where it holds");
    visit("seed_min_inliers",
          self.seed_min_inliers,
          "matches of the seed pair; relaxed when none qualifies",
          Range{8, 100000});
    visit("seed_min_angle_deg",
          self.seed_min_angle_deg,
          "triangulation angle of the seed pair; relaxed when none qualifies",
          Range{0.1, 90});
    visit("min_inliers",
          self.min_inliers,
          "scene points an image must agree with to be registered",
          Range{6, 10000});
    visit("max_error_px",
          self.max_error_px,
          "observations further off are removed, pixels at the equator",
          Range{0.1, 100});
    visit("min_angle_deg",
          self.min_angle_deg,
          "points seen under a smaller angle are removed",
          Range{0.01, 45});
    visit("two_view_below",
          self.two_view_below,
          "images with this many observations of longer tracks keep no points of two",
          Range{0, 1000000});
    visit("local_window",
          self.local_window,
          "images in the local adjustment after each registration",
          Range{2, 1000});
    visit("global_growth",
          self.global_growth,
          "share of new images or points that triggers a global adjustment",
          Range{0.01, 10});
    visit("max_seeds",
          self.max_seeds,
          "seed pairs tried per component before giving up",
          Range{1, 1000});
    visit("min_component_images",
          self.min_component_images,
          "smaller components are not kept",
          Range{2, 1000});
  }
};

/// One panorama as the mapper sees it: rays.
struct ClusterImage {
  ImageId id{};
  EquirectangularCamera camera{};
  std::vector<Eigen::Vector3d> bearings{};  ///< per feature, unit
  std::vector<float> sigma_rad{};           ///< per feature
  std::vector<Rgb> colors{};                ///< per feature
  PosePrior prior{};
  uint32_t drive = 0;
};

/// Everything one cluster needs, and nothing else: its size does not depend on the job's.
struct ClusterProblem {
  std::vector<ClusterImage> images{};    ///< sorted by id
  std::vector<TwoViewGeometry> pairs{};  ///< among `images`, sorted by pair
};

struct NotRegistered {
  ImageId image{};
  std::string reason{};
};

struct ClusterReconstruction {
  /// Largest first; an image is in at most one. Each in its own frame and scale.
  std::vector<Reconstruction> components{};
  std::vector<NotRegistered> not_registered{};
  std::vector<ImagePair> contradicted_pairs{};  ///< by the components; JudgePairs
  std::vector<ImagePair> explained_pairs{};
  int num_joined = 0;  ///< components fewer, since bridges joined them
  int num_global_adjustments = 0;
  int num_local_adjustments = 0;
  double residual_rms_px = 0.0;
  bool started_globally = false;  ///< the largest component
  std::string start_remark{};     ///< why not globally, or what speaks against it; empty: nothing
};

/// Incremental spherical SfM: seed pair (or all images at once, options.start), next-best image by
/// visibility on the sphere, P3P, triangulation, track completion and merging, filtering, local and
/// global adjustment, retries, several components. No component is a value (every image in
/// `not_registered`). Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<ClusterReconstruction> ReconstructCluster(
    const ClusterProblem& problem, const MappingOptions& options, const StageContext& context);

}  // namespace orbweave
