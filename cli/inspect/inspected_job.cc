// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/inspect/inspected_job.h"

#include <cctype>
#include <filesystem>
#include <utility>

#include "cli/results/finished_job.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

absl::StatusOr<JobStatus> JobToInspect(JobApi& coordinator, const std::string& output) {
  absl::StatusOr<JobStatus> finished = LastFinishedJob(coordinator, output);
  if (finished.ok() || !absl::IsFailedPrecondition(finished.status())) return finished;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobStatus> jobs, coordinator.ListJobs());
  if (jobs.empty()) return absl::FailedPreconditionError(output + " holds no job");
  return jobs.back();
}

/// One name per image, or why there is none.
absl::StatusOr<std::vector<Digest>> NamesOfFeatures(BlobAccess& coordinator,
                                                    const JobStatus& job,
                                                    const std::vector<TaskOutcome>& outcomes,
                                                    size_t num_images) {
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<Digest> names,
                            FetchFeatureNames(coordinator, job.spec, outcomes));
  if (names.size() == num_images) return names;
  return absl::FailedPreconditionError("the job stopped before all features were extracted");
}

/// None while nobody looked for them.
absl::StatusOr<std::vector<Carrier>> CarriersSoFar(BlobAccess& coordinator,
                                                   const JobSpec& job,
                                                   const std::vector<TaskOutcome>& outcomes) {
  absl::StatusOr<std::vector<Carrier>> carriers = FetchCarriers(coordinator, job, outcomes);
  if (absl::IsNotFound(carriers.status())) return std::vector<Carrier>{};
  return carriers;
}

}  // namespace

absl::StatusOr<std::unique_ptr<InspectedJob>> InspectedJob::Open(const std::string& output,
                                                                 const Clock& clock) {
  std::unique_ptr<InspectedJob> job(new InspectedJob());
  ORBWEAVE_ASSIGN_OR_RETURN(job->coordinator_, OpenFinished(output, clock));
  ORBWEAVE_ASSIGN_OR_RETURN(job->status_, JobToInspect(*job->coordinator_, output));
  const JobSpec& spec = job->status_.spec;
  ORBWEAVE_ASSIGN_OR_RETURN(job->outcomes_, job->coordinator_->GetOutcomes(job->status_.id));
  ORBWEAVE_ASSIGN_OR_RETURN(job->options_, PipelineOptionsFromText(spec.options_text, "the job"));
  absl::StatusOr<ImageManifest> manifest = FetchManifest(*job->coordinator_, spec, job->outcomes_);
  if (absl::IsNotFound(manifest.status())) {
    return absl::FailedPreconditionError("the job in " + output +
                                         " stopped before its images were read");
  }
  ORBWEAVE_RETURN_IF_ERROR(manifest.status());
  job->manifest_ = *std::move(manifest);
  ORBWEAVE_ASSIGN_OR_RETURN(job->carriers_,
                            CarriersSoFar(*job->coordinator_, spec, job->outcomes_));
  job->names_ = NamesOfFeatures(
      *job->coordinator_, job->status_, job->outcomes_, job->manifest_.images.size());
  return job;
}

absl::StatusOr<std::optional<JobResults>> InspectedJob::Results(ModelListener& listener) {
  if (status_.state != JobState::kDone) return std::nullopt;
  ORBWEAVE_ASSIGN_OR_RETURN(JobResults results,
                            FetchResults(*coordinator_, status_.spec, outcomes_, &listener));
  return results;
}

absl::StatusOr<Features> InspectedJob::FetchFeaturesOf(ImageId image) {
  ORBWEAVE_RETURN_IF_ERROR(names_.status());
  return FetchFeatures(*coordinator_, names_->at(image.value));
}

PictureImage InspectedJob::Picture(ImageId image, std::string& remark) {
  const ImageRecord& record = manifest_.At(image);
  PictureImage picture{.name = PrintableText(record.name), .camera = record.camera};
  if (record.content.IsZero()) {
    remark = "the job came from a database, which has no pixels";
    return picture;
  }
  absl::StatusOr<std::string> bytes = coordinator_->Get(record.content);
  if (bytes.ok()) {
    picture.encoded = *std::move(bytes);
  } else {
    remark = "without the pixels of " + picture.name + ", whose file is no longer what it was";
  }
  return picture;
}

std::string FileStemOf(const std::string& name) {
  std::string stem = std::filesystem::path(name).stem().string();
  for (char& c : stem) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    if (!is_plain) c = '_';
  }
  return stem;
}

}  // namespace orbweave
