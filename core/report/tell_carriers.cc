// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/tell_carriers.h"

#include <algorithm>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"

namespace orbweave {
namespace {

constexpr double kWorthAMask = 0.01;  // of what a camera sees around it

double ShareOf(const Carrier& carrier) {
  return static_cast<double>(carrier.cells.size()) / kNumCarrierCells;
}

bool HasMasks(const Carrier& carrier, const ImageManifest& manifest) {
  return std::ranges::any_of(carrier.images,
                             [&](ImageId image) { return !manifest.At(image).mask.IsZero(); });
}

/// Of a drive, whatever other drives there are: a job may read what an earlier one left.
std::string MaskFile(const std::string& first_image) {
  const std::string stem = first_image.substr(0, first_image.rfind('.'));
  return absl::StrCat("carrier_of_", absl::StrReplaceAll(stem, {{"/", "_"}}), ".png");
}

/// What to do: a mask that is there already knows more than cells in which features are.
std::string Advice(const std::vector<ReportCarrier>& masks) {
  if (masks.empty()) return "a mask over it (--masks FILE is one for all)";
  return absl::StrCat("a mask over it (",
                      masks.front().mask_file,
                      " is one to begin with, --masks FILE one for all)");
}

}  // namespace

void TellCarriers(const JobResults& results, JobReport& report) {
  if (results.carriers.empty()) return;
  const Carrier& largest = *std::ranges::max_element(results.carriers, {}, ShareOf);
  if (ShareOf(largest) < kWorthAMask) return;
  for (const Carrier& carrier : results.carriers) {
    if (ShareOf(carrier) < kWorthAMask || HasMasks(carrier, results.manifest)) continue;
    report.carriers.push_back(
        {MaskFile(results.manifest.At(carrier.images.front()).name), carrier.cells});
  }
  report.warnings.push_back(absl::StrFormat(
      "what goes along with the camera shows in up to %.1f %% of what it sees around it (drives: "
      "%u, for example that of %s), and is not matched there; %s leaves its features to the street",
      100.0 * ShareOf(largest),
      results.carriers.size(),
      results.manifest.At(largest.images.front()).name,
      Advice(report.carriers)));
}

}  // namespace orbweave
