// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>

namespace orbweave {

/// How many slots of workers are wanted: as many as there were tasks at any moment of the last
/// minute, ready or running, up to a limit. So a stage of one task between two of many does not
/// send the workers away that the next one wants. Time is handed in and never goes back.
class WantedSlots {
 public:
  static constexpr double kHold_s = 60.0;

  explicit WantedSlots(uint32_t limit) : limit_(limit) {}

  /// From now on there are so many tasks.
  void Note(uint64_t tasks, double now_s);
  [[nodiscard]] uint32_t At(double now_s) const;

 private:
  struct Past {
    uint64_t tasks = 0;
    double until_s = 0.0;
  };

  uint32_t limit_;
  uint64_t tasks_ = 0;
  std::deque<Past> past_;  ///< more tasks than those that follow and than now, in order of time
};

}  // namespace orbweave
