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

#include "core/artifacts/adjustment_records.h"

namespace orbweave {

/// Subproblems of a global adjustment that stay in this process between two half-steps, so that the
/// process that gets a subproblem's next request need not read and linearise it again. A memo and
/// nothing more: the next request of a cached subproblem gets the same reply, to the byte, as of
/// one made anew. Holds at most `max_observations` (kBytesPerObservation of memory each).
/// Thread-safe.
class SubproblemCache {
 public:
  /// Memory of a cached subproblem per observation, its points, poses and elimination included.
  static constexpr size_t kBytesPerObservation = 256;

  explicit SubproblemCache(size_t max_observations) : max_observations_(max_observations) {}

  /// A subproblem that is ready for a request.
  struct Ready {
    SubproblemSolver worker;
    LmRequest request;  ///< the task's, as seen from where `worker` stands
  };

  /// The subproblem of `task` where it stands at the task's state, made with the same options;
  /// nullopt: not here. It is the caller's now.
  [[nodiscard]] std::optional<Ready> Take(const SubproblemTask& task,
                                          std::string_view options_text);

  /// `worker` has done `task`, which led to `result`. Not cached after the last filter.
  void Keep(const SubproblemTask& task,
            const SubproblemResult& result,
            std::string_view options_text,
            SubproblemSolver worker);

 private:
  /// Where a cached subproblem stands: at `state` with these points shortened, and perhaps at a
  /// trial that starts there.
  struct Entry {
    Digest subproblem{};
    std::string options_text{};
    Digest state{};
    std::vector<ShortenedPoint> shortened{};
    BundleLoss loss{};
    Digest trial{};
    uint64_t last_use = 0;
    SubproblemSolver worker;
  };
  using Place = std::list<Entry>::iterator;

  [[nodiscard]] static std::optional<Ready> ReadyFor(const SubproblemTask& task,
                                                     std::string_view options_text,
                                                     Entry entry);

  [[nodiscard]] size_t CachedObservations() const;
  [[nodiscard]] Place NextToGo();

  const size_t max_observations_;
  std::mutex mutex_;
  uint64_t uses_ = 0;
  std::list<Entry> entries_;  ///< by last use
};

}  // namespace orbweave
