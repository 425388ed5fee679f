// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/io/geoid_heights.h"
#include "core/io/image_sources.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

template <>
struct EnumNames<HeightDatum> {
  static constexpr std::array<std::pair<HeightDatum, std::string_view>, 3> kNames = {
      {{HeightDatum::kEllipsoid, "ellipsoid"},
       {HeightDatum::kEgm96, "egm96"},
       {HeightDatum::kEgm2008, "egm2008"}}};
};

struct IngestOptions {
  double gnss_sigma_m = 5.0;
  double gnss_vertical_factor = 2.0;
  double heading_sigma_deg = 10.0;
  double tilt_sigma_deg = 3.0;
  double drive_gap_s = 600.0;
  HeightDatum height = HeightDatum::kEllipsoid;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("gnss_sigma_m",
          self.gnss_sigma_m,
          "horizontal standard deviation of positions that state none, metres",
          Range{0.001, 10000});
    visit("gnss_vertical_factor",
          self.gnss_vertical_factor,
          "vertical over horizontal standard deviation",
          Range{0.1, 100});
    visit("heading_sigma_deg",
          self.heading_sigma_deg,
          "standard deviation of headings that state none",
          Range{0.001, 180});
    visit("tilt_sigma_deg",
          self.tilt_sigma_deg,
          "standard deviation of pitch and roll that state none",
          Range{0.001, 180});
    visit("drive_gap_s",
          self.drive_gap_s,
          "a longer pause between two images begins a new drive",
          Range{0.001, 1e9});
    visit("height", self.height, "what altitudes are counted from: the ellipsoid, or a geoid");
  }
};

/// Decides which sources take part and what is known of each: drops files with a problem, images
/// that are not 2:1 (within a pixel) and byte-for-byte duplicates, each with its reason; numbers
/// the rest in natural name order; joins GNSS rows by full name, else base name, else stem (where
/// unique), else EXIF; puts the origin of the east-north-up frame at the rounded median position.
/// Mixed sizes are allowed. For times and drives see assign_drives.h. GNSS rows
/// without an image, images without a position, and masks of other proportions than their
/// image (then not used) become warnings; so does a direction that nobody measured
/// (DropSharedAngles). InvalidArgument: nothing is left (with the first
/// reasons), or the table is wrong. FailedPrecondition: altitudes are counted from a geoid whose
/// grid is not installed.
[[nodiscard]] absl::StatusOr<ImageManifest> IngestImages(const ImageSources& sources,
                                                         const IngestOptions& options,
                                                         const StageContext& context);

}  // namespace orbweave
