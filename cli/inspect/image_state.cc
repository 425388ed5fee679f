// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/inspect/image_state.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/report/build_job_report.h"

namespace orbweave {
namespace {

std::string JobStateText(JobState state) {
  switch (state) {
    case JobState::kFailed:
      return "the job failed";
    case JobState::kCancelled:
      return "the job was cancelled";
    default:
      return "the job has not ended, or another version of orbweave ran it";
  }
}

}  // namespace

std::string RegistrationText(const JobReport& report, ImageId image) {
  const ReportImage& row = report.images[image.value];
  if (row.registered && !row.loose) return absl::StrCat("registered in model ", row.model);
  std::string reason = "nobody knows why";
  for (const Exclusion& missing : report.not_registered) {
    if (missing.name == row.name) reason = missing.reason;
  }
  return (row.loose ? "placed loosely: " : "left out: ") + reason;
}

std::string ImageStateText(const InspectedJob& job,
                           const std::optional<JobResults>& results,
                           ImageId image) {
  const ImageRecord& record = job.manifest().At(image);
  const std::string state = results ? RegistrationText(BuildJobReport(*results), image)
                                    : JobStateText(job.status().state);
  return absl::StrFormat(
      "%s  %dx%d, %s", record.name, record.camera.width_px, record.camera.height_px, state);
}

}  // namespace orbweave
