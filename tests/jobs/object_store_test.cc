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
  explicit Fleet(const std::vector<std::string>& options, bool has_workers = true)
      : options_(options) {
    Serve();
    if (has_workers) StartWorkers();
  }

  void StartWorkers() {
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

  /// A command of a client: `orbweave WORDS[0] --coordinator ADDRESS WORDS[1]...`.
  CommandOutcome Ask(const std::vector<std::string>& words) {
    std::vector<std::string> command = {ORBWEAVE_BINARY, words.front(), "--coordinator", address_};
    command.insert(command.end(), words.begin() + 1, words.end());
    return RunCommand(command);
  }

  std::string State() const { return folder_ / "state"; }

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
  const CommandOutcome nothing_to_open = serve({"--store-keys", keys, "--root", "a=/tmp"});
  EXPECT_EQ(nothing_to_open.exit_code, 2);
  EXPECT_THAT(nothing_to_open.err, HasSubstr("--store-keys requires --store or --root"));
  const CommandOutcome twice =
      serve({"--store-keys", keys, "--root", "a=" + url, "--root", "b=" + url});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("is a root twice"));
  const CommandOutcome misspelt = serve({"--store", "s3:/blobs", "--store-keys", keys});
  EXPECT_EQ(misspelt.exit_code, 2);
}

/// `orbweave run` into `output` with these options besides.
CommandOutcome RunStreet(const std::string& images,
                         const std::string& output,
                         const std::vector<std::string>& options) {
  std::vector<std::string> command = {ORBWEAVE_BINARY,
                                      "run",
                                      images,
                                      "--gnss",
                                      StreetFolder() + "/gnss.csv",
                                      "--output",
                                      output,
                                      "--workers",
                                      "1"};
  command.insert(command.end(), options.begin(), options.end());
  return RunCommand(command);
}

TEST(ObjectStoreRun, LeavesTheSameBytesAndIsFoundAgainByWhoReadsTheResults) {
  FaultStore store;
  const TemporaryFolder folder;
  const std::string keys = KeysFile(folder, store);
  const std::string output = folder / "model";
  const CommandOutcome run = RunStreet(
      StreetFolder() + "/images", output, {"--store", store.Url("street"), "--store-keys", keys});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ExpectSameModel(ModelOfAFolder(), output);
  EXPECT_GT(store.Objects().size(), kPanoramas) << "its own workers have large blobs there";
  EXPECT_THAT(run.out + run.err, Not(HasSubstr(store.keys().secret_key)));
  const CommandOutcome exported =
      RunCommand({ORBWEAVE_BINARY, "export", output, "--database", folder / "model.db"});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  const size_t puts = store.Count("PUT");
  const CommandOutcome again = RunStreet(StreetFolder() + "/images", output, {});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(ComputedTasks(output), 0U) << "the store that it had is known";
  EXPECT_EQ(store.Count("PUT"), puts);
}

TEST(ObjectStoreRun, ReadsImagesWhereTheyLieBeneathARoot) {
  FaultStore store;
  const TemporaryFolder folder;
  for (const auto& file : std::filesystem::directory_iterator(StreetFolder() + "/images"))
    store.SetObject("city/images/" + file.path().filename().string(), ReadAll(file.path()));
  const std::string output = folder / "model";
  const CommandOutcome run =
      RunStreet(store.Url("city/images"),
                output,
                {"--root", "city=" + store.Url("city"), "--store-keys", KeysFile(folder, store)});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ExpectSameModel(ModelOfAFolder(), output);
  EXPECT_EQ(store.Count("PUT"), 0U);
  const std::string bytes = ReadAll(
      StreetFolder() + "/images/" +
      std::filesystem::directory_iterator(StreetFolder() + "/images")->path().filename().string());
  const std::string name = DigestOf(bytes).ToHex();
  EXPECT_FALSE(
      std::filesystem::exists(output + "/.orbweave/blobs/" + name.substr(0, 2) + "/" + name))
      << "images are not copied";
}

TEST(ObjectStoreRun, SaysWhatIsWrongWithAStore) {
  FaultStore store;
  const TemporaryFolder folder;
  const CommandOutcome misspelt = RunStreet(
      StreetFolder() + "/images", folder / "a", {"--store", "s3:/b", "--store-keys", "k"});
  EXPECT_EQ(misspelt.exit_code, 2) << misspelt.err;
  const CommandOutcome keyless =
      RunStreet(StreetFolder() + "/images", folder / "b", {"--store", store.Url("a")});
  EXPECT_NE(keyless.exit_code, 0);
  EXPECT_THAT(keyless.err, HasSubstr("AWS_ACCESS_KEY_ID"));
}

/// Images of the street in a store, and who may read them.
class ObjectImagesJob : public ::testing::Test {
 protected:
  explicit ObjectImagesJob(FaultStoreOptions options = {}) : store_(std::move(options)) {
    for (const auto& file : std::filesystem::directory_iterator(StreetFolder() + "/images"))
      store_.SetObject(KeyOf(file.path().filename()), ReadAll(file.path()));
    store_.SetObject("city/north/gnss.csv", ReadAll(StreetFolder() + "/gnss.csv"));
    ::unsetenv("AWS_ACCESS_KEY_ID");
  }

  static std::string KeyOf(const std::string& name) { return "city/north/images/" + name; }
  std::vector<std::string> Root() {
    return {"--root", "city=" + store_.Url("city"), "--store-keys", keys_};
  }
  std::vector<std::string> Submission() {
    return {"submit",
            store_.Url("city/north/images"),
            "--gnss",
            store_.Url("city/north/gnss.csv"),
            "--store-keys",
            keys_};
  }
  CommandOutcome Submit(Fleet& fleet, const std::string& output) {
    std::vector<std::string> words = Submission();
    words.insert(words.end(), {"--output", output});
    return fleet.Ask(words);
  }
  /// Images among the blobs in the coordinator's folder.
  static size_t CountCopies(const Fleet& fleet) {
    size_t copies = 0;
    for (const auto& image : std::filesystem::directory_iterator(StreetFolder() + "/images")) {
      const std::string hex = DigestOf(ReadAll(image.path())).ToHex();
      copies += std::filesystem::exists(fleet.State() + "/blobs/" + hex.substr(0, 2) + "/" + hex);
    }
    return copies;
  }

  const TemporaryFolder folder_;
  FaultStore store_;
  const std::string keys_ = KeysFile(folder_, store_);
};

TEST_F(ObjectImagesJob, LeaveTheSameBytesAsAFolderAndAreNotCopied) {
  Fleet fleet(Root());
  const CommandOutcome submitted = Submit(fleet, folder_ / "model");
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  ExpectSameModel(folder_ / "model", ModelOfAFolder());
  EXPECT_EQ(CountCopies(fleet), 0U);
  EXPECT_EQ(store_.Count("PUT") + store_.Count("DELETE"), 0U);
  fleet.End();
}

TEST_F(ObjectImagesJob, AreSentWhereTheCoordinatorHasThemNotAsARoot) {
  Fleet fleet({});
  const CommandOutcome submitted = Submit(fleet, folder_ / "model");
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  ExpectSameModel(folder_ / "model", ModelOfAFolder());
  EXPECT_EQ(CountCopies(fleet), kPanoramas);
  fleet.End();
}

TEST_F(ObjectImagesJob, AreReadByRunToo) {
  const CommandOutcome ran = RunCommand({ORBWEAVE_BINARY,
                                         "run",
                                         store_.Url("city/north/images"),
                                         "--gnss",
                                         store_.Url("city/north/gnss.csv"),
                                         "--store-keys",
                                         keys_,
                                         "--output",
                                         folder_ / "model"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  ExpectSameModel(folder_ / "model", ModelOfAFolder());
}

class FaultyObjectImagesJob : public ObjectImagesJob {
 protected:
  FaultyObjectImagesJob()
      : ObjectImagesJob({.slow_down_share = 0.1, .cut_share = 0.1, .delay_s = 0.01}) {}
};

TEST_F(FaultyObjectImagesJob, LeaveTheSameBytesWhereTheStoreFailsNowAndThen) {
  std::vector<std::string> options = Root();
  options.insert(options.end(), {"--store", store_.Url("blobs")});
  Fleet fleet(options);
  const CommandOutcome submitted = Submit(fleet, folder_ / "model");
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  ExpectSameModel(folder_ / "model", ModelOfAFolder());
  EXPECT_EQ(CountCopies(fleet), 0U);
  EXPECT_GT(store_.Faults(), 3U);
  fleet.End();
}

TEST_F(ObjectImagesJob, AnImageThatChangesAfterItWasSubmittedIsNamedAndNothingIsLost) {
  Fleet fleet(Root(), false);
  const CommandOutcome submitted = fleet.Ask(Submission());
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  const std::string job = submitted.out.substr(0, 12);
  const auto [key, bytes] = *store_.Objects().lower_bound(KeyOf(""));
  store_.SetObject(key, bytes + "changed");
  fleet.StartWorkers();
  const CommandOutcome failed = fleet.Ask({"status", job, "--watch"});
  const std::string status = fleet.Ask({"status", job}).out + failed.out + failed.err;
  EXPECT_THAT(status, HasSubstr("s3://blobs/" + key + " was changed after it was submitted"));
  store_.SetObject(key, bytes);
  ASSERT_EQ(fleet.Ask({"retry", job}).exit_code, 0);
  (void)fleet.Ask({"status", job, "--watch"});
  const CommandOutcome fetched = fleet.Ask({"fetch", job, "--output", folder_ / "model"});
  ASSERT_EQ(fetched.exit_code, 0) << fetched.err;
  ExpectSameModel(folder_ / "model", ModelOfAFolder());
  fleet.End();
}

TEST_F(ObjectImagesJob, WhatIsWrongWithTheAddressIsSaidByMessageAndExitCode) {
  Fleet fleet(Root(), false);
  const auto submit = [&](const std::string& address, const std::string& keys) {
    return fleet.Ask({"submit", address, "--store-keys", keys});
  };
  const CommandOutcome empty = submit(store_.Url("city/south"), keys_);
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.err, HasSubstr("no images in s3://blobs/city/south"));
  std::string other = store_.Url("city");
  other.replace(other.find("blobs"), 5, "globs");
  const CommandOutcome bucket = submit(other, keys_);
  EXPECT_EQ(bucket.exit_code, 2);
  EXPECT_THAT(bucket.err, HasSubstr("NoSuchBucket"));
  WriteAll(folder_ / "other.keys", "aws_access_key_id = A\naws_secret_access_key = B\n");
  ::chmod((folder_ / "other.keys").c_str(), 0600);
  const CommandOutcome rights = submit(store_.Url("city"), folder_ / "other.keys");
  EXPECT_EQ(rights.exit_code, 2);
  EXPECT_THAT(rights.err, HasSubstr("the keys need the rights"));
  const CommandOutcome without_keys = fleet.Ask({"submit", store_.Url("city")});
  EXPECT_EQ(without_keys.exit_code, 2);
  EXPECT_THAT(without_keys.err, HasSubstr("AWS_ACCESS_KEY_ID"));
  std::string nobody;
  {
    FaultStore gone;
    nobody = gone.Url("city");
  }
  const CommandOutcome away = submit(nobody, keys_);
  EXPECT_EQ(away.exit_code, 3) << away.err;
  EXPECT_THAT(away.err, HasSubstr("127.0.0.1"));
  const CommandOutcome misspelt = submit("s3:///city", keys_);
  EXPECT_EQ(misspelt.exit_code, 2);
  fleet.End();
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
