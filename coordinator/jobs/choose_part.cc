// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/choose_part.h"

#include <algorithm>

namespace orbweave {
namespace {

/// Shorter stretches are not divided: their parts share too little.
constexpr uint32_t kLeastToDivide = 4;

template <typename MayTake>
std::optional<uint32_t> ChooseByHome(const StageRun& run,
                                     const WorkerSlot& at,
                                     const std::vector<std::string>& alive,
                                     bool ahead,
                                     const MayTake& may_take) {
  if (const auto own = run.ready_at.find(at); own != run.ready_at.end()) {
    const auto part = std::ranges::find_if(own->second, may_take);
    if (part != own->second.end()) return *part;
  }
  std::optional<uint32_t> nobodys;
  std::optional<uint32_t> somebodys;
  for (const auto& [home, parts] : run.ready_at) {
    if (std::ranges::binary_search(alive, home.worker)) {
      const auto last = std::find_if(parts.rbegin(), parts.rend(), may_take);
      if (last != parts.rend() && (!somebodys || *somebodys < *last)) somebodys = *last;
    } else {
      const auto first = std::ranges::find_if(parts, may_take);
      if (first != parts.end() && (!nobodys || *first < *nobodys)) nobodys = *first;
    }
  }
  return nobodys || ahead ? nobodys : somebodys;
}

/// Where a worker had better begin that has no part before it.
uint32_t BeginOf(const ReadyParts::Stretch& stretch, const StageRun& run) {
  const bool is_worked_towards = stretch.first > 0 && run.running.contains(stretch.first - 1);
  if (!is_worked_towards || stretch.size() < kLeastToDivide) return stretch.first;
  return stretch.first + stretch.size() / 2;
}

template <typename MayTake>
std::optional<uint32_t> ChooseNeighbour(const StageRun& run,
                                        const std::string& worker,
                                        const MayTake& may_take) {
  if (run.ready.empty()) return std::nullopt;
  for (const uint32_t part : run.failed) {
    if (run.ready.Contains(part) && may_take(part)) return part;
  }
  const auto last = run.last_parts.find(worker);
  if (last != run.last_parts.end()) {
    const uint32_t next = last->second + 1;
    if (run.ready.Contains(next) && may_take(next)) return next;
  }
  const uint32_t begin = BeginOf(run.ready.Longest(), run);
  return may_take(begin) ? begin : run.ready.FindFirst(may_take);
}

}  // namespace

std::optional<uint32_t> ChoosePart(const StageRun& run,
                                   const WorkerSlot& at,
                                   const std::vector<std::string>& alive,
                                   double now_s,
                                   bool ahead) {
  if (ahead && !run.IsQuick()) return std::nullopt;
  const auto may_take = [&](uint32_t part) {
    return run.tasks[part].MayTake(at.worker, alive, now_s) &&
           !(ahead && run.failed.contains(part));
  };
  return run.homes.empty() ? ChooseNeighbour(run, at.worker, may_take)
                           : ChooseByHome(run, at, alive, ahead, may_take);
}

}  // namespace orbweave
