// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/stages/adjustment_records.h"

namespace orbweave {

/// Blocks of a global adjustment that stay in this process between two half-steps, so that the
/// process that gets a block's next order need not read and linearise it again. A memo and nothing
/// more: the next order of a kept block gets the same answer, to the byte, as of one made anew.
/// Holds at most `max_observations` (kBytesPerObservation of memory each). Thread-safe.
class KeptBlocks {
 public:
  /// Memory of a kept block per observation, its points, poses and elimination included.
  static constexpr size_t kBytesPerObservation = 256;

  explicit KeptBlocks(size_t max_observations) : max_observations_(max_observations) {}

  /// A block that is ready for an order.
  struct Ready {
    BlockWorker worker;
    BlockOrder order;  ///< the task's, as seen from where `worker` stands
  };

  /// The block of `task` where it stands at the task's state, made with the same options; nullopt:
  /// not here. It is the caller's now.
  [[nodiscard]] std::optional<Ready> Take(const BlockTask& task, std::string_view options_text);

  /// `worker` has done `task`, which led to `result`. Not kept after the last filter.
  void Keep(const BlockTask& task,
            const BlockResult& result,
            std::string_view options_text,
            BlockWorker worker);

 private:
  /// Where a kept block stands: at `state` with these points shortened, and perhaps at a trial
  /// that starts there.
  struct Entry {
    Digest block{};
    std::string options_text{};
    Digest state{};
    std::vector<ShortenedPoint> shortened{};
    BundleLoss loss{};
    Digest trial{};
    uint64_t last_use = 0;
    BlockWorker worker;
  };
  using Place = std::list<Entry>::iterator;

  [[nodiscard]] static std::optional<Ready> ReadyFor(const BlockTask& task,
                                                     std::string_view options_text,
                                                     Entry entry);

  [[nodiscard]] size_t KeptObservations() const;
  [[nodiscard]] Place NextToGo();

  const size_t max_observations_;
  std::mutex mutex_;
  uint64_t uses_ = 0;
  std::list<Entry> entries_;  ///< by last use
};

}  // namespace orbweave
