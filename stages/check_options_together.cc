// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/check_options_together.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

/// Whether the view graph of this many images may be divided (PartitionViewGraph).
bool MayBeDivided(const PartitionOptions& options, const JobShape& job) {
  if (job.num_clusters_by_hand > 0) return job.num_clusters_by_hand > 1;
  return NumClusters(job.num_images, options) > 1;
}

/// Ceres adjusts a whole model in one piece (AdjustSubproblems).
absl::Status CheckSolver(const PipelineOptions& options, const JobShape& job) {
  if (options.bundle.solver != BundleSolver::kCeres) return absl::OkStatus();
  if (MayBeDivided(options.partition, job)) {
    return absl::InvalidArgumentError(absl::StrCat(
        "bundle.solver=ceres adjusts one cluster only, these ",
        job.num_images,
        " images may become several: add ",
        job.num_clusters_by_hand > 0 ? "no clusters by hand and partition.cluster_size=0"
                                     : "partition.cluster_size=0",
        ", or leave out bundle.solver=ceres"));
  }
  if (job.num_images >= static_cast<size_t>(options.blocks.distribute_from)) {
    return absl::InvalidArgumentError(
        absl::StrCat("bundle.solver=ceres is not used for models of blocks.distribute_from=",
                     options.blocks.distribute_from,
                     " images and more, and there are ",
                     job.num_images,
                     ": raise blocks.distribute_from, or leave out bundle.solver=ceres"));
  }
  return absl::OkStatus();
}

/// A seam gets more overlap up to partition.max_overlap (ReviewSeams).
absl::Status CheckOverlap(const PartitionOptions& options, const JobShape& job) {
  if (options.reviews == 0 || options.max_overlap >= options.overlap || !MayBeDivided(options, job))
    return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("partition.max_overlap=",
                   options.max_overlap,
                   " is less than partition.overlap=",
                   options.overlap,
                   ", so no seam could be given more: raise the first, lower the second, or add "
                   "partition.reviews=0"));
}

/// What the paper's preset settles whatever options say (ScheduleOf, AsPresetAdjusts).
absl::Status CheckPreset(const PipelineOptions& options) {
  const MappingOptions& mapping = options.mapping;
  if (mapping.preset != MappingPreset::kPaper) return absl::OkStatus();
  const auto refuse = [](const char* does, const char* option) {
    return absl::InvalidArgumentError(absl::StrCat(
        "mapping.preset=paper ", does, ", whatever ", option, " says: leave out one of them"));
  };
  if (mapping.start != MappingStart::kIncremental)
    return refuse("starts from a seed pair", "mapping.start");
  if (options.bundle.residual != BundleResidual::kErpPx)
    return refuse("adjusts by pixels in the image", "bundle.residual");
  if (options.bundle.loss != BundleLoss::kLeastSquares)
    return refuse("adjusts without a loss", "bundle.loss");
  if (mapping.local_window != MappingOptions{}.local_window)
    return refuse("adjusts new images alone", "mapping.local_window");
  if (mapping.two_view_below != MappingOptions{}.two_view_below)
    return refuse("keeps points of two images", "mapping.two_view_below");
  return absl::OkStatus();
}

absl::Status CheckMapping(const MappingOptions& options, const JobShape& job) {
  // Too few images for the default are for the report to say.
  const bool is_asked_for = options.min_component_images > MappingOptions{}.min_component_images;
  if (is_asked_for && static_cast<size_t>(options.min_component_images) > job.num_images) {
    return absl::InvalidArgumentError(
        absl::StrCat("there are ",
                     job.num_images,
                     " images, and mapping.min_component_images=",
                     options.min_component_images,
                     " keeps no model of so few: give more images, or lower it"));
  }
  return absl::OkStatus();
}

absl::Status CheckInliers(const std::string& name, int min_inliers, int max_features) {
  if (min_inliers <= max_features) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(name,
                   "=",
                   min_inliers,
                   " asks for more matches than features.max_features=",
                   max_features,
                   " allows: lower the first or raise the second"));
}

/// What image jobs alone look at.
absl::Status CheckMatching(const PipelineOptions& options, const JobShape& job) {
  const int max_features = options.features.max_features;
  ORBWEAVE_RETURN_IF_ERROR(
      CheckInliers("two_view.min_inliers", options.two_view.min_inliers, max_features));
  ORBWEAVE_RETURN_IF_ERROR(
      CheckInliers("mapping.min_inliers", options.mapping.min_inliers, max_features));
  const PairOptions& pairs = options.pairs;
  const bool every_two = job.num_images < static_cast<size_t>(pairs.exhaustive_below);
  const bool by_gnss = pairs.gnss_radius_m > 0.0 && pairs.gnss_max_neighbours > 0;
  if (every_two || pairs.sequence_window > 0 || by_gnss || options.retrieval.num_neighbours > 0)
    return absl::OkStatus();
  return absl::InvalidArgumentError(
      "no two images would be paired: pairs.sequence_window, pairs.gnss_max_neighbours (or "
      "pairs.gnss_radius_m) and retrieval.num_neighbours are all 0; raise one of them");
}

}  // namespace

absl::Status CheckDenseOptions(const SourceOptions& options) {
  if (options.near_m >= options.far_m) {
    return absl::InvalidArgumentError(absl::StrCat("sources.near_m=",
                                                   options.near_m,
                                                   " is not nearer than sources.far_m=",
                                                   options.far_m,
                                                   ": lower the first or raise the second"));
  }
  if (options.min_angle_deg >= options.max_angle_deg) {
    return absl::InvalidArgumentError(
        absl::StrCat("no two panoramas would be compared: sources.min_angle_deg=",
                     options.min_angle_deg,
                     " is not less than sources.max_angle_deg=",
                     options.max_angle_deg,
                     "; lower the first or raise the second"));
  }
  return absl::OkStatus();
}

absl::Status CheckOptionsTogether(const PipelineOptions& options, const JobShape& job) {
  ORBWEAVE_RETURN_IF_ERROR(CheckSolver(options, job));
  ORBWEAVE_RETURN_IF_ERROR(CheckOverlap(options.partition, job));
  ORBWEAVE_RETURN_IF_ERROR(CheckPreset(options));
  ORBWEAVE_RETURN_IF_ERROR(CheckMapping(options.mapping, job));
  ORBWEAVE_RETURN_IF_ERROR(CheckDenseOptions(options.sources));
  return job.has_matches ? absl::OkStatus() : CheckMatching(options, job);
}

}  // namespace orbweave
