// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/list_unchecked.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

std::string CountOf(size_t part, size_t whole) {
  return part == whole ? "" : absl::StrCat(" of ", part, " of ", whole, " registered panoramas");
}

/// Loose images hold nothing: no length rests on them.
bool IsSupported(const ReportImage& image) { return image.registered && !image.loose; }

/// Registered images without a capture time.
size_t CountWithoutTimes(const JobResults& results, const JobReport& report) {
  return static_cast<size_t>(
      std::ranges::count_if(results.manifest.images, [&report](const ImageRecord& image) {
        return IsSupported(report.images[image.id.value]) &&
               !std::isfinite(image.capture_time_s.value_or(NAN));
      }));
}

}  // namespace

std::vector<std::string> ListUnchecked(const JobResults& results, const JobReport& report) {
  if (report.registered == 0) return {};
  std::vector<std::string> unchecked;
  const auto without_gnss =
      static_cast<size_t>(std::ranges::count_if(report.images, [&report](const ReportImage& image) {
        return IsSupported(image) && !report.IsGeoreferenced(image);
      }));
  if (without_gnss > 0) {
    unchecked.push_back(absl::StrCat(
        "the lengths of the steps",
        CountOf(without_gnss, report.registered),
        " along the street, but by rays that several pairs share: no GNSS tells them"));
  }
  const size_t without_times = CountWithoutTimes(results, report);
  if (without_gnss < report.registered && without_times > 0) {
    unchecked.push_back(absl::StrCat("whether a vehicle can have made the steps",
                                     CountOf(without_times, report.registered),
                                     ": they have no capture times"));
  }
  return unchecked;
}

}  // namespace orbweave
