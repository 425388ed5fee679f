// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fleet/patient_coordinator.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "worker/retry.h"

namespace orbweave {
namespace {

/// No call is cancelled by this side: a coordinator that stops does so to those that run.
bool IsAway(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsCancelled(status);
}

/// Hands the pieces of a blob on that come by several attempts, each of which begins anew: every
/// byte once.
class ResumedTaking {
 public:
  /// `take` outlives it.
  explicit ResumedTaking(const TakePiece& take) : take_(take) {}

  /// What the next attempt gives its pieces to.
  [[nodiscard]] TakePiece Begin() {
    return [this, seen_bytes = uint64_t{0}](std::string_view piece) mutable {
      const uint64_t again = std::min<uint64_t>(piece.size(), taken_bytes_ - seen_bytes);
      seen_bytes += piece.size();
      piece.remove_prefix(again);
      if (piece.empty()) return absl::OkStatus();
      taken_bytes_ += piece.size();
      taken_.Add(piece);
      refused_ = take_(piece);
      return refused_;
    };
  }
  [[nodiscard]] const absl::Status& refused() const { return refused_; }
  /// The digest of what was taken. No attempt knows it: it has seen its own bytes alone.
  [[nodiscard]] Digest Finish() { return taken_.Finish(); }

 private:
  const TakePiece& take_;
  uint64_t taken_bytes_ = 0;
  DigestBuilder taken_;
  absl::Status refused_;
};

/// The pieces of a blob for several attempts, as long as they get no further than the first piece:
/// of a call that finds nobody gRPC has asked for one.
class ResumedGiving {
 public:
  /// `next` outlives it.
  explicit ResumedGiving(const NextPiece& next) : next_(next) {}

  [[nodiscard]] NextPiece Begin() {
    return [this, is_first = true]() mutable -> absl::StatusOr<std::string_view> {
      if (std::exchange(is_first, false) && asked_ == 1) return std::string_view(first_);
      const absl::StatusOr<std::string_view> piece = next_();
      if (++asked_ > 1 || !piece.ok()) return piece;
      first_ = *piece;
      return std::string_view(first_);
    };
  }
  [[nodiscard]] bool CanBeginAgain() const { return asked_ <= 1; }

 private:
  const NextPiece& next_;
  size_t asked_ = 0;
  std::string first_;
};

}  // namespace

absl::Status PatientCoordinator::Away(const absl::Status& why) const {
  return absl::UnavailableError(
      absl::StrCat("no coordinator answers at ", patience_.address, ": ", why.message()));
}

void PatientCoordinator::SayAway(const absl::Status& why) {
  if (!is_away_.exchange(true) && patience_.on_away) patience_.on_away(Away(why));
}

template <typename Call>
auto PatientCoordinator::Wait(Call&& call) -> decltype(call()) {
  using Clock = std::chrono::steady_clock;
  const auto give_up = Clock::now() + std::chrono::duration<double>(patience_.wait_s);
  bool is_given_up = false;
  const auto goes_on = [&](const absl::Status& why) {
    is_given_up = Clock::now() >= give_up;
    if (!is_given_up) SayAway(why);
    return !is_given_up;
  };
  auto answer = Retry({.stop = patience_.stop, .is_passing = IsAway, .goes_on = goes_on}, call);
  const absl::Status status = internal::StatusOf(answer);
  if (!IsAway(status)) {
    is_away_ = false;
    return answer;
  }
  if (is_given_up) return Away(status);
  return absl::CancelledError("interrupted while the coordinator was away");
}

absl::StatusOr<std::string> PatientCoordinator::Get(const Digest& digest) {
  return Wait([&] { return api_->Get(digest); });
}

absl::StatusOr<Digest> PatientCoordinator::Put(std::string_view bytes) {
  return Wait([&] { return api_->Put(bytes); });
}

absl::Status PatientCoordinator::Read(const Digest& digest, const TakePiece& take) {
  ResumedTaking taking(take);
  // Who takes the pieces is not the coordinator: its error is the end, whichever it is.
  absl::Status refused;
  const absl::Status read = Wait([&]() -> absl::Status {
    const absl::Status status = api_->Read(digest, taking.Begin());
    refused = taking.refused();
    return refused.ok() ? status : absl::OkStatus();
  });
  ORBWEAVE_RETURN_IF_ERROR(read);
  ORBWEAVE_RETURN_IF_ERROR(refused);
  if (taking.Finish() == digest) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat("blob ", digest.ToShortHex(), " arrived damaged"));
}

absl::Status PatientCoordinator::Write(const Digest& digest,
                                       uint64_t size_bytes,
                                       const NextPiece& next) {
  ResumedGiving giving(next);
  absl::Status cut_off;
  const absl::Status written = Wait([&]() -> absl::Status {
    absl::Status status = api_->Write(digest, size_bytes, giving.Begin());
    if (giving.CanBeginAgain()) return status;
    cut_off = std::move(status);
    return absl::OkStatus();
  });
  ORBWEAVE_RETURN_IF_ERROR(written);
  return absl::IsUnavailable(cut_off) ? Away(cut_off) : cut_off;
}

absl::StatusOr<std::vector<std::string>> PatientCoordinator::DrainWorkers(const std::string& name) {
  return Wait([&] { return api_->DrainWorkers(name); });
}

absl::Status PatientCoordinator::StopCoordinator() {
  return Wait([&] { return api_->StopCoordinator(); });
}

absl::StatusOr<Digest> PatientCoordinator::SubmitJob(const JobSpec& job) {
  return Wait([&] { return api_->SubmitJob(job); });
}

absl::StatusOr<JobStatus> PatientCoordinator::GetJob(const Digest& job) {
  return Wait([&] { return api_->GetJob(job); });
}

absl::StatusOr<std::vector<JobStatus>> PatientCoordinator::ListJobs() {
  return Wait([&] { return api_->ListJobs(); });
}

absl::StatusOr<std::vector<WorkerStatus>> PatientCoordinator::ListWorkers() {
  return Wait([&] { return api_->ListWorkers(); });
}

absl::StatusOr<uint32_t> PatientCoordinator::CountWantedSlots() {
  return Wait([&] { return api_->CountWantedSlots(); });
}

absl::Status PatientCoordinator::CancelJob(const Digest& job) {
  return Wait([&] { return api_->CancelJob(job); });
}

absl::StatusOr<std::vector<TaskOutcome>> PatientCoordinator::GetOutcomes(const Digest& job) {
  return Wait([&] { return api_->GetOutcomes(job); });
}

absl::StatusOr<std::vector<TaskTiming>> PatientCoordinator::GetTimings(const Digest& job) {
  return Wait([&] { return api_->GetTimings(job); });
}

absl::StatusOr<std::vector<MeasuredTask>> PatientCoordinator::GetCosts(const Digest& job) {
  return Wait([&] { return api_->GetCosts(job); });
}

absl::StatusOr<std::vector<bool>> PatientCoordinator::StatBlobs(
    const std::vector<Digest>& digests) {
  return Wait([&] { return api_->StatBlobs(digests); });
}

absl::Status PatientCoordinator::LinkFile(const Digest& digest, const std::string& path) {
  return Wait([&] { return api_->LinkFile(digest, path); });
}

absl::Status PatientCoordinator::ForgetJob(const Digest& job) {
  return Wait([&] { return api_->ForgetJob(job); });
}

absl::StatusOr<GarbageReport> PatientCoordinator::CollectGarbage(const GarbageOptions& options) {
  return Wait([&] { return api_->CollectGarbage(options); });
}

}  // namespace orbweave
