// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a coordinator tells whoever runs it: whether it moves, whether it can work, and how many
// workers it has work for.

#include "absl/strings/str_cat.h"
#include "coordinator/coordinator.h"

namespace orbweave {

absl::Status Coordinator::CheckLive() const {
  const double now_s = clock_.NowSeconds();
  const auto check = [&](const Pulse& pulse, const char* name) {
    if (pulse.IsFelt(options_.lease_s, now_s)) return absl::OkStatus();
    return absl::UnavailableError(
        absl::StrCat("the ", name, " has not moved for ", options_.lease_s, " s"));
  };
  ORBWEAVE_RETURN_IF_ERROR(check(planner_.pulse(), "planner"));
  return check(matchmaker_.pulse(), "matchmaker");
}

absl::Status Coordinator::CheckReady() {
  ORBWEAVE_RETURN_IF_ERROR(Annotate(journal_->TrySave(), "journal"));
  ORBWEAVE_RETURN_IF_ERROR(Annotate(
      blobs_.Probe(absl::StrCat("probe of generation ", journal_->generation())), "blobs"));
  const std::lock_guard lock(mutex_);
  ORBWEAVE_RETURN_IF_ERROR(health_);
  return stopping_ ? absl::UnavailableError("the coordinator is shutting down") : absl::OkStatus();
}

uint32_t Coordinator::SlotsWanted() {
  const std::lock_guard lock(mutex_);
  const double now_s = clock_.NowSeconds();
  wanted_.Note(dispatcher_.jobs().CountOpenTasks(), now_s);
  return wanted_.At(now_s);
}

}  // namespace orbweave
