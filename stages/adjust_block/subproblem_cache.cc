// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/adjust_block/subproblem_cache.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace orbweave {

std::optional<SubproblemCache::Ready> SubproblemCache::Take(const SubproblemTask& task,
                                                            std::string_view options_text) {
  const std::lock_guard lock(mutex_);
  ++uses_;
  const Place it = std::ranges::find(entries_, task.subproblem, &Entry::subproblem);
  if (it == entries_.end()) return std::nullopt;
  Entry entry = std::move(*it);
  entries_.erase(it);
  return ReadyFor(task, options_text, std::move(entry));
}

std::optional<SubproblemCache::Ready> SubproblemCache::ReadyFor(const SubproblemTask& task,
                                                                std::string_view options_text,
                                                                Entry entry) {
  LmRequest request = task.request;
  if (task.state.IsZero() || entry.options_text != options_text || entry.loss != request.loss)
    return std::nullopt;
  const bool is_there = entry.state == task.state && entry.shortened == request.shortened;
  if (!is_there && entry.trial != task.state) return std::nullopt;
  request.takes_trial = !is_there;
  return Ready{std::move(entry.worker), std::move(request)};
}

void SubproblemCache::Keep(const SubproblemTask& task,
                           const SubproblemResult& result,
                           std::string_view options_text,
                           SubproblemSolver worker) {
  using Work = LmRequest::Work;
  const LmRequest& request = task.request;
  if (request.work == Work::kFilter && !request.evaluates_again) return;
  const bool begins = request.work == Work::kEvaluate || request.work == Work::kFilter;
  Entry entry{.subproblem = result.subproblem.IsZero() ? task.subproblem : result.subproblem,
              .options_text = std::string(options_text),
              .state = begins ? result.state : task.state,
              .shortened = begins ? std::vector<ShortenedPoint>{} : request.shortened,
              .loss = request.loss,
              .trial = request.work == Work::kTrial ? result.state : Digest{},
              .worker = std::move(worker)};
  const std::lock_guard lock(mutex_);
  entry.last_use = uses_;
  entries_.push_back(std::move(entry));
  while (CachedObservations() > max_observations_) entries_.erase(NextToGo());
}

size_t SubproblemCache::CachedObservations() const {
  size_t sum = 0;
  for (const Entry& entry : entries_) sum += entry.worker.num_observations();
  return sum;
}

/// Subproblems come round and round, so that the one just used is needed last. One that was not
/// asked for in several rounds belongs to an adjustment that is over.
SubproblemCache::Place SubproblemCache::NextToGo() {
  constexpr uint64_t kRounds = 8;
  const bool oldest_is_over = uses_ - entries_.front().last_use > kRounds * entries_.size();
  return oldest_is_over ? entries_.begin() : std::prev(entries_.end());
}

}  // namespace orbweave
