// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/list_unchecked.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

std::string CountOf(size_t part, size_t whole) {
  return part == whole ? "" : absl::StrCat(" of ", part, " of ", whole, " registered panoramas");
}

/// Loose images hold nothing: no length rests on them.
bool IsSupported(const ReportImage& image) { return image.registered && !image.loose; }

/// Registered images of drives without capture times.
size_t CountWithoutTimes(const JobResults& results, const JobReport& report) {
  size_t count = 0;
  for (const auto& [drive, sequence] : SequenceOfDrives(results.manifest)) {
    if (HaveTimes(results.manifest, sequence)) continue;
    count += static_cast<size_t>(std::ranges::count_if(
        sequence, [&](ImageId image) { return IsSupported(report.images[image.value]); }));
  }
  return count;
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
