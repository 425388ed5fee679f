// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/list_unchecked.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

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

/// What checks say that nothing told; one sentence for all of a name.
std::vector<std::string> UntoldChecks(const std::vector<CrossCheck>& checks) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> sentences;
  for (const CrossCheck& check : checks) {
    if (check.is_told) continue;
    if (!sentences.contains(check.name)) names.push_back(check.name);
    sentences[check.name].push_back(check.sentence);
  }
  std::vector<std::string> untold;
  for (const std::string& name : names) {
    const std::vector<std::string>& alike = sentences.at(name);
    untold.push_back(alike.front());
    if (alike.size() > 1) absl::StrAppend(&untold.back(), "; ", alike.size() - 1, " more like it");
  }
  return untold;
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
  std::ranges::move(UntoldChecks(report.checks), std::back_inserter(unchecked));
  return unchecked;
}

}  // namespace orbweave
