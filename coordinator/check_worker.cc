// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/check_worker.h"

#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "core/pipeline/build_version.h"
#include "security/identity.h"

namespace orbweave {
namespace {

constexpr uint32_t kMostSlots = 1024;
constexpr WorkerOffers kMostOffers{
    .memory_bytes = uint64_t{1} << 50, .threads = 65'536, .gpus = 4096};

/// The text of a stranger, as long as it may stand in an error.
std::string Quoted(std::string_view text) {
  constexpr size_t kMost = 200;
  return absl::StrCat("'", std::string(text.substr(0, kMost)), "'");
}

absl::Status CheckVersion(const WorkerInfo& worker) {
  if (worker.version == BuildVersion()) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("worker ",
                                                    worker.name,
                                                    " is orbweave ",
                                                    Quoted(worker.version),
                                                    ", the coordinator is ",
                                                    std::string(BuildVersion()),
                                                    ": install the same version on both"));
}

absl::Status CheckWorkerName(std::string_view name) {
  const size_t slash = name.find('/');
  const std::string_view rest = slash == name.npos ? "none" : name.substr(slash + 1);
  if (CheckName(name.substr(0, slash)).ok() && CheckName(rest).ok()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("a worker's name is one, or two with '/' between them, of 1 to 100 letters, "
                   "digits, '.', '_' and '-' that begin with a letter or digit, not ",
                   Quoted(name)));
}

}  // namespace

absl::Status CheckWorker(const WorkerInfo& worker) {
  ORBWEAVE_RETURN_IF_ERROR(CheckWorkerName(worker.name));
  ORBWEAVE_RETURN_IF_ERROR(CheckVersion(worker));
  if (worker.slots < 1 || worker.slots > kMostSlots) {
    return absl::InvalidArgumentError(
        absl::StrCat("a worker has 1 to ", kMostSlots, " slots, not ", worker.slots));
  }
  const WorkerOffers& offers = worker.offers;
  if (offers.memory_bytes <= kMostOffers.memory_bytes && offers.threads <= kMostOffers.threads &&
      offers.gpus <= kMostOffers.gpus) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrCat("no worker offers ",
                                                 offers.memory_bytes,
                                                 " bytes of memory, ",
                                                 offers.threads,
                                                 " threads and ",
                                                 offers.gpus,
                                                 " GPUs"));
}

}  // namespace orbweave
