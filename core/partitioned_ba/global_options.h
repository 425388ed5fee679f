// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/bundle/bundle_report.h"
#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

enum class GnssUse { kAuto, kOff };

template <>
struct EnumNames<GnssUse> {
  static constexpr std::array<std::pair<GnssUse, std::string_view>, 2> kNames = {
      {{GnssUse::kAuto, "auto"}, {GnssUse::kOff, "off"}}};
};

struct GlobalAdjustOptions {
  GnssUse gnss = GnssUse::kAuto;
  double gnss_bias_sigma_m = 2.0;
  double max_error_px = 4.0;
  double min_angle_deg = 1.5;
  int rounds = 2;
  bool attach_loose = true;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("gnss", self.gnss, "use GNSS positions as robust terms when they agree with the model");
    visit("gnss_bias_sigma_m",
          self.gnss_bias_sigma_m,
          "expected constant GNSS offset of one drive",
          Range{0, 1000});
    visit("max_error_px",
          self.max_error_px,
          "observations further off are removed, pixels at the equator",
          Range{0.1, 100});
    visit("min_angle_deg",
          self.min_angle_deg,
          "points seen under a smaller angle are removed",
          Range{0.01, 45});
    visit("rounds",
          self.rounds,
          "adjust and filter rounds before the final least squares",
          Range{1, 10});
    visit("attach_loose",
          self.attach_loose,
          "place images that could not be registered at their GNSS position, marked as loose");
  }
};

/// Where the global adjustment is computed; results do not depend on it.
struct DistributionOptions {
  int distribute_from = 1000;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("distribute_from",
          self.distribute_from,
          "models of this many images are adjusted block by block on all workers; smaller ones on "
          "one, by the same steps",
          Range{0, 1000000000});
  }
};

/// What GNSS said and how far it was believed; part of the report.
struct GnssReport {
  bool used = false;
  std::string reason{};  ///< why it is not used
  uint32_t num_priors = 0;
  uint32_t num_inliers = 0;
  double residual_median_m = 0.0;  ///< horizontal and vertical together, after adjustment
  double residual_rms_inliers_m = 0.0;
  double deformation_m = 0.0;           ///< Georeference::deformation_m
  std::vector<std::string> outliers{};  ///< names of images whose GNSS position is contradicted
};

/// What the uncertainty of poses refers to; part of the report.
struct UncertaintyReport {
  bool known = false;
  std::string reason{};  ///< why not
  /// The image whose pose counts as exact, and the one whose distance to it does. Empty: nothing is
  /// held, GNSS makes the uncertainty that of places on earth.
  std::string held_image{};
  std::string held_distance_to{};
  /// A-posteriori over claimed sigma (VarianceFactors) of bearings and of GNSS; 1 without GNSS.
  double bearing_sigma_factor = 1.0;
  double horizontal_gnss_sigma_factor = 1.0;
  double vertical_gnss_sigma_factor = 1.0;
};

struct GlobalAdjustReport {
  GnssReport gnss{};
  UncertaintyReport uncertainty{};
  std::vector<BundleReport> adjustments{};            ///< per phase
  std::vector<std::vector<double>> accepted_costs{};  ///< per phase, the initial one first
  /// Per subproblem: what it sends for a step, at most.
  std::vector<uint64_t> bytes_of_subproblem{};
  uint64_t num_observations = 0;
  uint32_t removed_observations = 0;
  uint32_t removed_tracks = 0;
  std::vector<Exclusion>
      weak_images{};  ///< taken out for want of support (JudgeSupport) or as misplaced, and why
  double residual_px_mean = 0.0;  ///< angle x W / 2pi
  double residual_px_rms = 0.0;
  double pattern_px = 0.0;           ///< what repeats in every panorama (ResidualPattern)
  std::vector<CrossCheck> checks{};  ///< in the order in which they were made
};

}  // namespace orbweave
