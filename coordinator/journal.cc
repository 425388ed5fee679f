// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal.h"

#include <algorithm>
#include <filesystem>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "coordinator/durable_file.h"
#include "proto/codec/coordinator_codec.h"

namespace orbweave {
namespace {

std::string ResultName(const Digest& task) { return "results/" + task.ToHex(); }
std::string JobName(const Digest& job) { return "jobs/" + job.ToHex(); }

absl::StatusOr<JobEntry> EntryFromText(const std::string& content) {
  v1::JobFile file;
  if (!file.ParseFromString(content)) return absl::DataLossError("no job file");
  JobEntry entry{.error = file.error(), .number = file.number()};
  ORBWEAVE_ASSIGN_OR_RETURN(entry.spec, FromProto(file.spec()));
  ORBWEAVE_ASSIGN_OR_RETURN(entry.state, JobStateFromProto(file.state()));
  return entry;
}

}  // namespace

absl::StatusOr<Journal> Journal::Open(const std::string& folder) {
  Journal journal(folder);
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder + "/results"));
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder + "/jobs"));
  ORBWEAVE_RETURN_IF_ERROR(MakeEmptyFolder(folder + "/tmp"));
  ORBWEAVE_RETURN_IF_ERROR(journal.BeginGeneration());
  return journal;
}

absl::Status Journal::BeginGeneration() {
  const absl::StatusOr<std::string> previous = Load("generation");
  if (previous.ok() && !absl::SimpleAtoi(*previous, &generation_)) {
    return absl::DataLossError(absl::StrCat(folder_, "/generation is no number"));
  }
  if (!previous.ok() && !absl::IsNotFound(previous.status())) return previous.status();
  ++generation_;
  return Save("generation", absl::StrCat(generation_));
}

absl::Status Journal::Save(const std::string& name, const std::string& content) const {
  return WriteFileDurably(
      folder_ + "/tmp", absl::StrCat(folder_, "/", name), ToProto(DigestOf(content)) + content);
}

absl::StatusOr<std::string> Journal::Load(const std::string& name) const {
  const std::string path = absl::StrCat(folder_, "/", name);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadWholeFile(path));
  constexpr size_t kHeader = sizeof(Digest::bytes);
  const std::string content = bytes.substr(std::min(kHeader, bytes.size()));
  if (bytes.substr(0, kHeader) != ToProto(DigestOf(content))) {
    return absl::DataLossError(absl::StrCat(path, " is damaged"));
  }
  return content;
}

absl::Status Journal::SaveResult(const Digest& task, const TaskResult& result) {
  return Save(ResultName(task), ToProto(result).SerializeAsString());
}

absl::StatusOr<TaskResult> Journal::LoadResult(const Digest& task) const {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string content, Load(ResultName(task)));
  v1::TaskResult proto;
  if (!proto.ParseFromString(content)) {
    return absl::DataLossError(
        absl::StrCat("the result of task ", task.ToShortHex(), " is damaged"));
  }
  return FromProto(proto);
}

absl::Status Journal::SaveJob(const JobEntry& job) {
  v1::JobFile file;
  *file.mutable_spec() = ToProto(job.spec);
  file.set_state(static_cast<uint32_t>(job.state));
  file.set_error(job.error);
  file.set_number(job.number);
  return Save(JobName(job.spec.Id()), file.SerializeAsString());
}

absl::StatusOr<std::vector<JobEntry>> Journal::LoadJobs() const {
  std::vector<JobEntry> jobs;
  std::error_code error;
  for (const auto& file : std::filesystem::directory_iterator(folder_ + "/jobs", error)) {
    const absl::StatusOr<std::string> content = Load("jobs/" + file.path().filename().string());
    if (!content.ok()) continue;
    absl::StatusOr<JobEntry> entry = EntryFromText(*content);
    if (entry.ok()) jobs.push_back(*std::move(entry));
  }
  if (error)
    return absl::UnavailableError(
        absl::StrCat("cannot list ", folder_, "/jobs: ", error.message()));
  std::sort(jobs.begin(), jobs.end(), [](const JobEntry& a, const JobEntry& b) {
    return a.number < b.number;
  });
  return jobs;
}

}  // namespace orbweave
