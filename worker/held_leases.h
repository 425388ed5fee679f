// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <stop_token>
#include <vector>

#include "core/pipeline/worker_api.h"

namespace orbweave {

/// The leases a worker works on, shared by its slots (which add, report and remove) and its
/// heartbeat (which lists and stops them). Thread-safe.
class HeldLeases {
 public:
  /// The returned token is stopped when the lease is to be given up.
  [[nodiscard]] std::stop_token Add(const Lease& lease);
  void Report(uint64_t epoch, const Progress& progress);
  void Remove(uint64_t epoch);

  [[nodiscard]] std::vector<LeaseProgress> List() const;
  void StopTask(const Digest& task);
  void StopAll();

 private:
  struct Held {
    LeaseProgress progress{};
    std::stop_source stop{};
  };
  mutable std::mutex mutex_;
  std::map<uint64_t, Held> held_;  ///< by epoch
};

}  // namespace orbweave
