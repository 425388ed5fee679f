// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A coordinator with an object store and two workers without keys to it, all processes of their
// own.

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <memory>

#include "tests/jobs/corridor_job.h"
#include "tests/support/fault_store.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr size_t kPanoramas = 8;

const std::string& StreetFolder() {
  static const TemporaryFolder folder;
  static const std::string path = [] {
    const CommandOutcome made = RunCommand({ORBWEAVE_BINARY,
                                            "synth",
                                            "street",
                                            "--panoramas",
                                            std::to_string(kPanoramas),
                                            "--size",
                                            "1024x512",
                                            "--output",
                                            folder.Path()});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder.Path();
  }();
  return path;
}

std::string KeysFile(const TemporaryFolder& folder, const FaultStore& store) {
  const std::string path = folder / "store.keys";
  WriteAll(path,
           "aws_access_key_id = " + store.keys().access_key +
               "\naws_secret_access_key = " + store.keys().secret_key + "\n");
  ::chmod(path.c_str(), 0600);
  return path;
}

/// A coordinator with an object store or without one, two workers, and commands.
class Fleet {
 public:
  explicit Fleet(const std::vector<std::string>& options) : options_(options) {
    Serve();
    for (const char* name : {"w1", "w2"}) {
      workers_.push_back(std::make_unique<Command>(
          std::vector<std::string>{ORBWEAVE_BINARY, "work", "--join", address_, "--name", name}));
    }
  }

  void Serve() {
    std::filesystem::remove(folder_ / "socket");
    std::vector<std::string> arguments = {
        ORBWEAVE_BINARY, "serve", "--listen", address_, "--state", folder_ / "state"};
    arguments.insert(arguments.end(), options_.begin(), options_.end());
    serve_ = std::make_unique<Command>(arguments);
    EXPECT_TRUE(WaitUntil([&] { return std::filesystem::exists(folder_ / "socket"); }, 20))
        << serve_->ErrSoFar();
  }

  std::unique_ptr<Command> Submit(const std::string& output) {
    return std::make_unique<Command>(std::vector<std::string>{ORBWEAVE_BINARY,
                                                              "submit",
                                                              "--coordinator",
                                                              address_,
                                                              StreetFolder() + "/images",
                                                              "--gnss",
                                                              StreetFolder() + "/gnss.csv",
                                                              "--output",
                                                              output});
  }

  void Kill() {
    serve_->Signal(SIGKILL);
    serve_->Wait();
  }

  /// Sends all home; nobody has written a granted URL to its log.
  void End() {
    serve_->Signal(SIGINT);
    workers_.push_back(std::move(serve_));
    for (const auto& process : workers_) {
      const CommandOutcome ended = process->Wait();
      EXPECT_EQ(ended.exit_code, 0) << ended.err;
      EXPECT_THAT(ended.err, Not(HasSubstr("X-Amz")));
    }
  }

 private:
  const std::vector<std::string> options_;
  const TemporaryFolder folder_;
  const std::string address_ = "unix:" + (folder_ / "socket");
  std::unique_ptr<Command> serve_;
  std::vector<std::unique_ptr<Command>> workers_;
};

/// One job of a fleet whose coordinator has these options; the model in `output`.
void Reconstruct(const std::string& output, const std::vector<std::string>& options) {
  Fleet fleet(options);
  const CommandOutcome submitted = fleet.Submit(output)->Wait();
  EXPECT_EQ(submitted.exit_code, 0) << submitted.err;
  fleet.End();
}

const std::string& ModelOfAFolder() {
  static const TemporaryFolder folder;
  static const std::string output = [] {
    Reconstruct(folder / "model", {});
    return folder / "model";
  }();
  return output;
}

TEST(ObjectStoreJob, LeavesTheSameBytesAsAFolderAndFewObjects) {
  FaultStore store;
  const TemporaryFolder folder;
  Reconstruct(folder / "model",
              {"--store", store.Url("street"), "--store-keys", KeysFile(folder, store)});
  ExpectSameModel(folder / "model", ModelOfAFolder());
  const size_t blobs = store.Objects().size() - 1;  // one says whose the store is
  EXPECT_GE(blobs, kPanoramas);                     // each has its features there
  EXPECT_LE(blobs, 3 * kPanoramas);
}

TEST(ObjectStoreJob, LeavesTheSameBytesWhereTheStoreFailsNowAndThen) {
  FaultStore store({.slow_down_share = 0.05, .cut_share = 0.05, .delay_s = 0.01});
  const TemporaryFolder folder;
  Reconstruct(folder / "model",
              {"--store", store.Url("street"), "--store-keys", KeysFile(folder, store)});
  ExpectSameModel(folder / "model", ModelOfAFolder());
  EXPECT_GT(store.Faults(), 0U);
}

TEST(ObjectStoreJob, ACoordinatorThatIsKilledGoesOnWithWhatIsInTheStore) {
  FaultStore store;
  const TemporaryFolder folder;
  Fleet fleet({"--store", store.Url("street"), "--store-keys", KeysFile(folder, store)});
  const auto submit = fleet.Submit(folder / "model");
  // Its images, and the features of some of them.
  ASSERT_TRUE(WaitUntil([&] { return store.Objects().size() > kPanoramas + 4; }, 60));
  fleet.Kill();
  fleet.Serve();
  const CommandOutcome submitted = submit->Wait();
  EXPECT_EQ(submitted.exit_code, 0) << submitted.err;
  fleet.End();
  ExpectSameModel(folder / "model", ModelOfAFolder());
}

TEST(ObjectStoreJob, ACoordinatorWithoutKeysOrStoreSaysSo) {
  const TemporaryFolder folder;
  std::string url;
  std::string keys;
  {
    FaultStore store;
    url = store.Url("street");
    keys = KeysFile(folder, store);
  }
  const auto serve = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {ORBWEAVE_BINARY,
                                          "serve",
                                          "--listen",
                                          "unix:" + folder / "socket",
                                          "--state",
                                          folder / "state"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return RunCommand(arguments);
  };
  ::unsetenv("AWS_ACCESS_KEY_ID");
  const CommandOutcome without_keys = serve({"--store", url});
  EXPECT_EQ(without_keys.exit_code, 2);
  EXPECT_THAT(without_keys.err, HasSubstr("AWS_ACCESS_KEY_ID"));
  const CommandOutcome nobody = serve({"--store", url, "--store-keys", keys});
  EXPECT_EQ(nobody.exit_code, 3) << nobody.err;
  EXPECT_THAT(nobody.err, HasSubstr("127.0.0.1"));
  const CommandOutcome misspelt = serve({"--store", "s3:/blobs", "--store-keys", keys});
  EXPECT_EQ(misspelt.exit_code, 2);
}

TEST(StoreCommand, PrintsATableAndSaysByItsExitCode) {
  FaultStore store;
  FaultStore other({.keys = {.access_key = "A", .secret_key = "B", .region = "test-1"}});
  const TemporaryFolder folder;
  const std::string keys = KeysFile(folder, store);
  const CommandOutcome good =
      RunCommand({ORBWEAVE_BINARY, "store", "check", store.Url("a"), "--store-keys", keys});
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("a grant of an hour ago is refused"));
  EXPECT_THAT(good.out, Not(HasSubstr("FAILED")));
  const CommandOutcome bad =
      RunCommand({ORBWEAVE_BINARY, "store", "check", other.Url("a"), "--store-keys", keys});
  EXPECT_EQ(bad.exit_code, 1) << bad.out << bad.err;
  EXPECT_THAT(bad.out, HasSubstr("SignatureDoesNotMatch"));
  EXPECT_THAT(bad.out + bad.err, Not(HasSubstr(store.keys().secret_key)));
}

}  // namespace
}  // namespace orbweave::testing
