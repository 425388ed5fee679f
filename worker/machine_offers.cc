// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/machine_offers.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

uint64_t MemoryOfMachine(const std::string& root) {
  std::ifstream info(root + "/proc/meminfo");
  for (std::string word; info >> word;) {
    uint64_t kibibytes = 0;
    if (word == "MemTotal:" && info >> kibibytes) return kibibytes << 10;
  }
  return 0;
}

/// The limit of the control group as it is seen from inside; 0: there is none, or it is "max".
uint64_t MemoryOfGroup(const std::string& root) {
  for (const char* path :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream limit(root + path);
    if (uint64_t bytes = 0; limit >> bytes) return bytes;
  }
  return 0;
}

uint32_t GpusOf(const std::string& root) {
  uint32_t gpus = 0;
  const auto is_there = [&] {
    return ::access(absl::StrCat(root, "/dev/nvidia", gpus).c_str(), R_OK | W_OK) == 0;
  };
  while (is_there()) ++gpus;
  return gpus;
}

}  // namespace

WorkerOffers OffersOfMachine(const std::string& root) {
  const uint64_t machine = MemoryOfMachine(root);
  const uint64_t group = MemoryOfGroup(root);
  return {.memory_bytes =
              group == 0 || machine == 0 ? std::max(machine, group) : std::min(machine, group),
          .gpus = GpusOf(root)};
}

WorkerOffers ShareOf(const WorkerOffers& machine, uint32_t index, uint32_t count) {
  return {.memory_bytes = machine.memory_bytes / count,
          .threads = machine.threads / count,
          .gpus = machine.gpus / count + (index < machine.gpus % count ? 1 : 0)};
}

}  // namespace orbweave
