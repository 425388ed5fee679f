// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/check_worker.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/pipeline/build_version.h"

namespace orbweave {
namespace {

WorkerInfo Named(const std::string& name) {
  return {.name = name, .version = std::string(BuildVersion())};
}

TEST(CheckWorker, TakesNamesOfHostsAndOfCertificates) {
  for (const char* name : {"w", "node7.example.org-4711", "node7/gpu_1", "7"})
    EXPECT_TRUE(CheckWorker(Named(name)).ok()) << name;
}

TEST(CheckWorker, RefusesWhatIsNoName) {
  const std::string lengthy(101, 'w');
  for (const std::string& name : {std::string(),
                                  std::string("a/b/c"),
                                  std::string("/a"),
                                  std::string("a/"),
                                  std::string("two words"),
                                  std::string("\x1b[2J"),
                                  std::string("*"),
                                  lengthy,
                                  "a/" + lengthy,
                                  std::string(1 << 20, 'x')}) {
    const absl::Status status = CheckWorker(Named(name));
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << name;
    EXPECT_LT(status.message().size(), 500U);
  }
}

TEST(CheckWorker, RefusesAnotherVersion) {
  EXPECT_TRUE(absl::IsFailedPrecondition(CheckWorker({.name = "w", .version = "another"})));
}

TEST(CheckWorker, BoundsSlotsAndOffers) {
  WorkerInfo worker = Named("w");
  for (const uint32_t slots : {0U, 1025U, std::numeric_limits<uint32_t>::max()}) {
    worker.slots = slots;
    EXPECT_TRUE(absl::IsInvalidArgument(CheckWorker(worker))) << slots;
  }
  worker.slots = 1024;
  EXPECT_TRUE(CheckWorker(worker).ok());
  constexpr uint64_t kTooMuch = std::numeric_limits<uint64_t>::max();
  constexpr uint32_t kTooMany = std::numeric_limits<uint32_t>::max();
  for (const WorkerOffers& offers :
       {WorkerOffers{.memory_bytes = kTooMuch}, {.threads = kTooMany}, {.gpus = kTooMany}}) {
    worker.offers = offers;
    EXPECT_TRUE(absl::IsInvalidArgument(CheckWorker(worker)));
  }
}

}  // namespace
}  // namespace orbweave
