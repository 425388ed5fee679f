// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worker/kept_blocks.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace orbweave {

std::optional<KeptBlocks::Ready> KeptBlocks::Take(const BlockTask& task,
                                                  std::string_view options_text) {
  const std::lock_guard lock(mutex_);
  ++uses_;
  const Place it = std::ranges::find(entries_, task.block, &Entry::block);
  if (it == entries_.end()) return std::nullopt;
  Entry entry = std::move(*it);
  entries_.erase(it);
  return ReadyFor(task, options_text, std::move(entry));
}

std::optional<KeptBlocks::Ready> KeptBlocks::ReadyFor(const BlockTask& task,
                                                      std::string_view options_text,
                                                      Entry entry) {
  BlockOrder order = task.order;
  if (task.state.IsZero() || entry.options_text != options_text || entry.loss != order.loss)
    return std::nullopt;
  const bool is_there = entry.state == task.state && entry.shortened == order.shortened;
  if (!is_there && entry.trial != task.state) return std::nullopt;
  order.takes_trial = !is_there;
  return Ready{std::move(entry.worker), std::move(order)};
}

void KeptBlocks::Keep(const BlockTask& task,
                      const BlockResult& result,
                      std::string_view options_text,
                      BlockWorker worker) {
  using Work = BlockOrder::Work;
  const BlockOrder& order = task.order;
  if (order.work == Work::kFilter && !order.begins_again) return;
  const bool begins = order.work == Work::kBegin || order.work == Work::kFilter;
  Entry entry{.block = result.block.IsZero() ? task.block : result.block,
              .options_text = std::string(options_text),
              .state = begins ? result.state : task.state,
              .shortened = begins ? std::vector<ShortenedPoint>{} : order.shortened,
              .loss = order.loss,
              .trial = order.work == Work::kTry ? result.state : Digest{},
              .worker = std::move(worker)};
  const std::lock_guard lock(mutex_);
  entry.last_use = uses_;
  entries_.push_back(std::move(entry));
  while (KeptObservations() > max_observations_) entries_.erase(NextToGo());
}

size_t KeptBlocks::KeptObservations() const {
  size_t sum = 0;
  for (const Entry& entry : entries_) sum += entry.worker.num_observations();
  return sum;
}

/// Blocks come round and round, so that the one just used is needed last. One that was not asked
/// for in several rounds belongs to an adjustment that is over.
KeptBlocks::Place KeptBlocks::NextToGo() {
  constexpr uint64_t kRounds = 8;
  const bool oldest_is_over = uses_ - entries_.front().last_use > kRounds * entries_.size();
  return oldest_is_over ? entries_.begin() : std::prev(entries_.end());
}

}  // namespace orbweave
