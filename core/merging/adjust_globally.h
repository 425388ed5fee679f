// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/bundle/adjust_bundle.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

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
  std::vector<std::string> outliers{};  ///< names of images whose GNSS position is contradicted
};

struct GlobalAdjustReport {
  GnssReport gnss{};
  std::vector<BundleReport> adjustments{};
  uint32_t removed_observations = 0;
  uint32_t removed_tracks = 0;
  std::vector<std::string>
      unobserved_images{};        ///< names of images left without observations; now loose
  double residual_px_mean = 0.0;  ///< angle x W / 2pi
  double residual_px_rms = 0.0;
};

struct GloballyAdjusted {
  Reconstruction reconstruction{};  ///< east-north-up metres when report.gnss.used
  GlobalAdjustReport report{};
};

/// Georeferences robustly (GeoreferenceReconstruction; ChooseLocalFrame where GNSS cannot carry a
/// scale and must not bend the model), then `rounds` times adjusts all poses and points with the
/// given loss and robust GNSS terms and filters (FilterObservations), and finishes with least
/// squares and a last filter. Loose images follow the frame but take no part. Cancelled when asked
/// to stop.
[[nodiscard]] absl::StatusOr<GloballyAdjusted> AdjustGlobally(Reconstruction reconstruction,
                                                              const ImageManifest& manifest,
                                                              const GlobalAdjustOptions& options,
                                                              const BundleOptions& bundle_options,
                                                              const StageContext& context);

}  // namespace orbweave
