// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// One image as the report shows it.
struct ReportImage {
  std::string name{};
  bool registered = false;
  bool loose = false;       ///< placed by GNSS and neighbours only
  std::string reason{};     ///< why it is not registered, or loose
  uint32_t model = 0;       ///< index of the written model (sparse/0, sparse/1, ...)
  int cluster = -1;         ///< cluster it is interior to; -1: none
  bool in_overlap = false;  ///< shared by two or more clusters
  uint32_t drive = 0;
  Rigid3 cam_from_world{};
  Eigen::Vector3d centre_in_world = Eigen::Vector3d::Zero();
  /// GNSS position, where its model is georeferenced, or where it has none and another one is.
  std::optional<Eigen::Vector3d> gnss_in_world{};
  bool gnss_outlier = false;
  uint32_t observations = 0;
  double residual_px_mean = 0.0;
  std::optional<PoseUncertainty> uncertainty{};

  /// "registered", "loose" or "not_registered".
  [[nodiscard]] std::string_view StateText() const {
    if (!registered) return "not_registered";
    return loose ? "loose" : "registered";
  }
};

struct ReportStage {
  std::string name{};
  double wall_s = 0.0;
  double cpu_s = 0.0;
  uint32_t tasks_computed = 0;
  uint32_t tasks_reused = 0;
  uint32_t retries = 0;
};

struct ReportCluster {
  uint32_t images = 0;  ///< interior and overlap
  uint32_t interior = 0;
  uint32_t registered = 0;
  uint32_t submodels = 0;
  uint64_t points = 0;
  double residual_px_rms = 0.0;
};

/// Whether the two sides of a seam agree within what the noise of bearings explains.
enum class SeamVerdict { kUnknown, kGood, kDoubtful, kBad };

/// How far apart the two sides would put the images of the overlap, and what noise explains.
struct ReportSeamFit {
  uint32_t images = 0;  ///< that both sides can place; 0: unknown
  double position_jump_m = 0.0;
  double rotation_jump_deg = 0.0;
  double position_noise_m = 0.0;
  double rotation_noise_deg = 0.0;

  /// The larger of both jumps over its noise.
  [[nodiscard]] double Ratio() const {
    const auto ratio = [](double jump, double noise) { return noise > 0.0 ? jump / noise : 0.0; };
    return std::max(ratio(position_jump_m, position_noise_m),
                    ratio(rotation_jump_deg, rotation_noise_deg));
  }
  [[nodiscard]] SeamVerdict Verdict() const {
    if (images == 0) return SeamVerdict::kUnknown;
    if (Ratio() < 3.0) return SeamVerdict::kGood;
    return Ratio() < 6.0 ? SeamVerdict::kDoubtful : SeamVerdict::kBad;
  }
};

struct ReportSeam {
  uint32_t cluster_a = 0;
  uint32_t cluster_b = 0;
  uint32_t common_images = 0;
  uint32_t common_tracks = 0;
  uint32_t inlier_tracks = 0;
  double condition_number = 0.0;
  double position_jump_m = 0.0;  ///< metres where georeferenced, model units otherwise
  double rotation_jump_deg = 0.0;
  bool used = true;
  bool contradicted = false;  ///< by loops, hence not used
  double drift_factor = 1.0;  ///< clusters bend by so many times what is expected to close loops
  std::string reason{};       ///< why it is not used
  ReportSeamFit after{};      ///< the global adjustment
};

struct ReportGnss {
  bool used = false;
  std::string reason{};  ///< why it is not used
  uint32_t num_priors = 0;
  uint32_t num_inliers = 0;
  double residual_median_m = 0.0;
  double residual_rms_inliers_m = 0.0;
  double deformation_m =
      0.0;  ///< that the model was bent to the positions, at most; 0: it was rigid
  std::vector<std::string> outliers{};  ///< names
};

/// Sigmas of a model's poses: of positions root of the trace, in its units (metres with
/// GNSS), of rotations rms angles.
struct ReportUncertainty {
  bool known = false;
  std::string reason{};            ///< why not
  std::string held_image{};        ///< whose pose counts as exact; empty: absolute by GNSS
  std::string held_distance_to{};  ///< whose distance to it counts as exact
  double bearing_sigma_factor = 1.0;
  double horizontal_gnss_sigma_factor = 1.0;
  double vertical_gnss_sigma_factor = 1.0;
  /// False where GNSS holds the frame and states no height: then the sigmas of positions, here and
  /// below, are those along the ground.
  bool heights_are_known = true;
  double position_median = 0.0;
  double position_p95 = 0.0;
  double rotation_median_deg = 0.0;
  double rotation_p95_deg = 0.0;
  std::vector<uint32_t> worst{};  ///< of JobReport.images, least certain first

  [[nodiscard]] double PositionSigma(const PoseUncertainty& pose) const {
    return heights_are_known ? pose.PositionSigma() : pose.PositionSigmas().head<2>().norm();
  }
};

/// One of the written models: sparse/N.
struct ReportModel {
  uint32_t images = 0;  ///< registered in it
  uint32_t loose = 0;   ///< placed in it loosely
  uint64_t points = 0;
  uint64_t observations = 0;
  double residual_px_mean = 0.0;
  ReportUncertainty uncertainty{};
  ReportGnss gnss{};  ///< used: the model has the job's east-north-up frame
  /// Between registered images that follow each other in a drive (JobReport.paths), world units.
  double step_median = 0.0;
  double path_length = 0.0;
  /// Else nothing tells the order of some drive: its part of step_median is the distance to the
  /// nearest image, and path_length lacks it.
  bool is_in_order = true;
};

/// Registered images of a model that follow one another in a drive, without a gap.
struct ReportPath {
  uint32_t model = 0;
  uint32_t drive = 0;
  std::vector<uint32_t> images{};  ///< of JobReport.images, as they were taken; two at least
};

/// One minimisation of the global adjustment: costs are half the sum of losses.
struct ReportPhase {
  int steps = 0;
  bool converged = false;
  std::vector<double> accepted_costs{};  ///< the initial one first
};

/// The global adjustment of one model.
struct ReportAdjustment {
  std::vector<ReportPhase> phases{};            ///< with the robust loss, then one of least squares
  std::vector<uint64_t> bytes_of_subproblem{};  ///< what each subproblem sends for a step, at most
};

struct ReportWorker {
  std::string name{};
  uint32_t slots = 1;
  uint32_t tasks_done = 0;
};

/// counts[i]: values in [i, i + 1) * bin_width; the last bin also holds all that are larger.
struct Histogram {
  double bin_width = 0.1;
  std::vector<uint64_t> counts{};
};

/// What was matched beside the first pairs, decided by what these showed (ChooseWiderPairs).
struct ReportWiderPairs {
  bool facades = false;      ///< all by features of facade views too, as the first showed too few
  uint64_t second = 0;       ///< pairs of which no strong chain told enough
  uint64_t held_back = 0;    ///< pairs of one drive, not matched: a strong chain joins their images
  uint64_t reserve = 0;      ///< pairs of images with few others
  uint64_t predicted = 0;    ///< pairs matched again, under what others predict of them
  uint64_t thin_images = 0;  ///< these images
};

/// Everything report.json and report.html tell. Residuals are angles times W / 2pi: pixels at the
/// equator.
/// What goes along with the camera of a drive without masks.
struct ReportCarrier {
  std::string mask_file{};        ///< of the output: a mask to begin with
  std::vector<uint32_t> cells{};  ///< of a Carrier
};

struct JobReport {
  std::string version{};
  std::string title{};  ///< of the page: the job's label
  uint32_t images_total = 0;
  uint32_t registered = 0;
  std::vector<Exclusion>
      not_registered{};  ///< excluded files and images without a pose, with reasons
  uint32_t models = 0;   ///< sparse/0 ... sparse/(models - 1)
  std::vector<ReportModel> each_model{};  ///< in order; most images first
  std::vector<ReportPath> paths{};        ///< by model, then drive (TracePaths)
  uint64_t points = 0;
  uint64_t observations = 0;
  double mean_track_length = 0.0;
  double residual_px_mean = 0.0;
  double residual_px_rms = 0.0;
  double residual_erp_px_mean = 0.0;  ///< distance in the image, seam unwrapped, as others print it
  Histogram residual_histogram{};
  std::vector<uint64_t> track_lengths{};  ///< [n]: points seen by n images; the last: by n or more
  std::vector<ReportCluster> clusters{};
  std::vector<ReportSeam> seams{};
  ReportGnss gnss{};                            ///< of the first model
  ReportUncertainty uncertainty{};              ///< of the first model
  std::vector<ReportAdjustment> adjustments{};  ///< per model
  std::optional<GeodeticPosition>
      origin{};  ///< of the east-north-up frame; absent: all models' frames are free
  std::vector<ReportStage> stages{};  ///< in order
  std::vector<ReportWorker> workers{};
  double elapsed_s = 0.0;
  std::array<uint64_t, kNumMatchRungs>
      pairs_of_rung{};  ///< verified pairs that stayed, by MatchRung
  ReportWiderPairs wider_pairs{};
  std::vector<CrossCheck> checks{};  ///< of all models, the largest model's first
  Verdict verdict{};
  std::vector<std::string> warnings{};
  std::vector<ReportCarrier> carriers{};  ///< those that are worth a mask and have none
  std::string options_text{};
  std::vector<ReportImage> images{};  ///< in id order

  /// Whether the image has a pose in the job's east-north-up frame.
  [[nodiscard]] bool IsGeoreferenced(const ReportImage& image) const {
    return image.registered && image.model < each_model.size() && each_model[image.model].gnss.used;
  }
};

}  // namespace orbweave
