// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/worker_offers.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"

namespace orbweave {
namespace {

/// One of the three things that are asked for.
struct Kind {
  uint64_t needed = 0;
  uint64_t most = 0;  ///< that a worker has; a worker's unknown memory is more than any need
  std::string (*name)(uint64_t amount) = nullptr;
};

std::string Memory(uint64_t bytes) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  return absl::StrFormat("%.4g GiB of memory", static_cast<double>(bytes) / kGiB);
}

std::string Threads(uint64_t count) {
  return absl::StrCat(count, count == 1 ? " thread" : " threads");
}

std::string Gpus(uint64_t count) { return absl::StrCat(count, count == 1 ? " GPU" : " GPUs"); }

std::string Describe(const Kind& kind) {
  if (kind.needed <= kind.most) return kind.name(kind.needed);
  const std::string most =
      kind.most == 0 ? "no worker has any" : "the most a worker has is " + kind.name(kind.most);
  return absl::StrCat(kind.name(kind.needed), " (", most, ")");
}

std::vector<Kind> KindsOf(const std::vector<WorkerOffers>& workers, const StageNeeds& needs) {
  Kind memory{needs.memory_bytes, 0, Memory};
  Kind threads{needs.threads, 0, Threads};
  Kind gpus{needs.gpus, 0, Gpus};
  for (const WorkerOffers& worker : workers) {
    memory.most =
        std::max(memory.most, worker.memory_bytes == 0 ? needs.memory_bytes : worker.memory_bytes);
    threads.most = std::max<uint64_t>(threads.most, worker.threads);
    gpus.most = std::max<uint64_t>(gpus.most, worker.gpus);
  }
  return {gpus, memory, threads};
}

}  // namespace

WorkerOffers WithThreads(const WorkerOffers& offers, uint32_t slots) {
  WorkerOffers said = offers;
  if (said.threads == 0) said.threads = slots;
  return said;
}

bool HasRoom(const WorkerOffers& offers,
             uint32_t slots,
             const StageNeeds& taken,
             const StageNeeds& needs) {
  const WorkerOffers said = WithThreads(offers, slots);
  const bool has_own_thread = offers.threads == 0 && needs.threads <= 1;
  const auto fits = [](uint64_t offered, uint64_t used, uint64_t needed) {
    return used <= offered && needed <= offered - used;
  };
  return (said.memory_bytes == 0 ||
          fits(said.memory_bytes, taken.memory_bytes, needs.memory_bytes)) &&
         (has_own_thread || fits(said.threads, taken.threads, needs.threads)) &&
         fits(said.gpus, taken.gpus, needs.gpus);
}

uint32_t TasksAtOnce(const WorkerOffers& offers, uint32_t slots, const StageNeeds& needs) {
  const WorkerOffers said = WithThreads(offers, slots);
  uint64_t tasks = slots;
  if (said.memory_bytes > 0 && needs.memory_bytes > 0)
    tasks = std::min(tasks, said.memory_bytes / needs.memory_bytes);
  if (needs.threads > 0) tasks = std::min<uint64_t>(tasks, said.threads / needs.threads);
  if (needs.gpus > 0) tasks = std::min<uint64_t>(tasks, said.gpus / needs.gpus);
  return static_cast<uint32_t>(tasks);
}

std::string DescribeMissing(const std::vector<WorkerOffers>& workers, const StageNeeds& needs) {
  std::vector<std::string> missing;
  std::vector<std::string> asked;
  for (const Kind& kind : KindsOf(workers, needs)) {
    if (kind.needed == 0) continue;
    asked.push_back(Describe(kind));
    if (kind.needed > kind.most) missing.push_back(asked.back());
  }
  if (!missing.empty()) return absl::StrJoin(missing, " and ");
  return absl::StrJoin(asked, " and ") + " (no worker has all of it)";
}

}  // namespace orbweave
