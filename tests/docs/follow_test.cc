// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Does what docs/operations.md and docs/security.md say, command by command, with real processes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "tests/docs/doc_walk.h"
#include "tests/support/http_collector.h"
#include "tests/support/postgres_server.h"

namespace orbweave::docs {
namespace {

const std::string kDocs = std::string(ORBWEAVE_SOURCE_DIR) + "/docs/";

/// A street that a job of a few seconds reconstructs.
void MakeStreet(DocWalk& walk) {
  (void)walk.Run("orbweave synth street --panoramas 8 --size 512x256 --output street");
}

/// The id of a job that is submitted and not waited for, as the document shortens it.
std::string ShortId(const std::string& printed) { return printed.substr(0, 12); }

TEST(Docs, OperationsIsWhatAnOperatorCanDo) {
  const testing::HttpCollector collector;
  const auto postgres = testing::PostgresServer::Start();
  DocWalk walk;
  const std::string coordinator = "127.0.0.1:" + FreePort();
  walk.Means("127.0.0.1:7000", coordinator);
  walk.Means("127.0.0.1:7001", "127.0.0.1:" + FreePort());
  walk.Means("127.0.0.1:9464", "127.0.0.1:" + FreePort());
  walk.Means("127.0.0.1:4318", "127.0.0.1:" + std::to_string(collector.port()));
  walk.Means("coordinator.example:7000", "localhost:" + FreePort());
  if (postgres) {
    walk.Means("postgresql://db/orbweave", "'" + postgres->MakeDatabase("orbweave") + "'");
  } else {
    walk.Means(" --journal postgresql://db/orbweave", "");
  }
  MakeStreet(walk);
  const std::string submit = "orbweave submit --coordinator 127.0.0.1:7000";
  const std::vector<Aside> asides = {
      {.command = submit,
       .after =
           [&] {
             const std::string jobs = walk.Run("orbweave jobs --coordinator 127.0.0.1:7000");
             std::smatch id;
             ASSERT_TRUE(std::regex_search(jobs, id, std::regex("job ([0-9a-f]{12})"))) << jobs;
             walk.Means("3f2a", id[1]);
             EXPECT_TRUE(std::filesystem::exists(walk / "model/report.html"));
           }},
      {.command = "orbweave work --join coordinator.example:7000",
       .before =
           [&] {
             (void)walk.Run("orbweave keys init keys --fleet city --host localhost");
             (void)walk.Run("orbweave keys add keys worker w2");
             (void)walk.Run("mkdir storage");
             walk.Start(
                 "orbweave serve --listen coordinator.example:7000 --tls keys/coordinator "
                 "--state storage/state");
           }},
      // A job that does not end before it is cancelled: its only worker stands still.
      {.command = "orbweave cancel",
       .before =
           [&] {
             walk.At("w1").Signal(SIGSTOP);
             const std::string id =
                 walk.Run(submit + " street/images --set features.max_features=3000");
             walk.Means("3f2a", ShortId(id));
           }},
      {.command = "orbweave retry", .after = [&] { walk.At("w1").Signal(SIGCONT); }},
      {.command = "orbweave drain --coordinator 127.0.0.1:7000 w1",
       .after = [&] { walk.ExpectEnd("w1", 0); }},
      {.command = "orbweave drain --coordinator 127.0.0.1:7000 'n7/*'",
       .before = [&] { walk.Start("orbweave work --join 127.0.0.1:7000 --name n7/a"); },
       .after = [&] { walk.ExpectEnd("n7_a", 0); }},
      {.command = "orbweave fetch",
       .before =
           [&] {
             walk.Start("orbweave work --join 127.0.0.1:7000 --name w3 --slots 2");
             (void)walk.Run("orbweave status --coordinator 127.0.0.1:7000 3f2a --watch");
             std::filesystem::remove_all(walk / "model");
           },
       .after = [&] { EXPECT_TRUE(std::filesystem::exists(walk / "model/report.html")); }},
      {.command = "orbweave stop",
       .after =
           [&] {
             walk.ExpectEnd("w3", 0);
             walk.ExpectEnd("serve1", 0);
           }},
      {.command = "cp -a state backup",
       .after = [&] { EXPECT_TRUE(std::filesystem::exists(walk / "backup/journal.db")); }}};
  const std::vector<Elsewhere> elsewhere = {
      {.command = "deploy/image.sh",
       .reason = "builds for minutes, as root; tests/deploy/image.sh runs it"},
      {.command = "kubectl",
       .reason =
           "no cluster in a test; tests/deploy/manifests.py renders and checks what is applied"},
      {.command = "orbweave store check",
       .reason = "no bucket in a test; tests/jobs/object_store_test.cc has a store of its own"},
      {.command =
           "orbweave serve --listen 0.0.0.0:7000 --tls keys/coordinator --state state --store",
       .reason = "likewise"},
      {.command =
           "orbweave serve --listen 0.0.0.0:7000 --tls keys/coordinator --state state --root",
       .reason = "likewise"},
      {.command = "orbweave run street/images --gnss street/gnss.csv --output model --store",
       .reason = "likewise"},
      {.command = "orbweave submit --coordinator coordinator.example:7000 --tls keys/client",
       .reason = "likewise"},
      {.command = "orbweave work --join coordinator.example:7000 --tls keys/w2",
       .reason = "likewise"},
      {.command = "orbweave launch slurm",
       .reason =
           "no Slurm in a test; its scripts are shown here, and tests/chaos/slurm.sh runs one",
       .instead = "orbweave launch slurm street/images --gnss street/gnss.csv --dense --output "
                  "launched --nodes 16 --cpus 8 --time 4:00:00 --sbatch=--account=city --wait "
                  "--print"}};
  walk.Follow(kDocs + "operations.md", asides, elsewhere);
  if (!postgres && !HasFailure()) GTEST_SKIP() << "PostgreSQL is not installed, all else was done";
}

TEST(Docs, SecurityIsWhatAnOperatorCanDo) {
  DocWalk walk;
  const std::string port = FreePort();
  walk.Means("coordinator.example:7000", "localhost:" + port);
  walk.Means("0.0.0.0:7000", "0.0.0.0:" + port);
  walk.Means("scp -p", "cp -p");  // this machine is all of them
  walk.Means("coordinator.example:", "");
  walk.Means("coordinator.example", "localhost");
  MakeStreet(walk);
  std::filesystem::rename(walk / "street/images", walk / "images");
  const std::vector<Aside> asides = {
      {.command = "orbweave keys init",
       .after = [&] { (void)walk.Run("cp -rp keys/coordinator keys/client ."); }},
      {.command = "orbweave keys token",
       .after =
           [&] {
             // One that stays unused, to be revoked.
             const std::string made = walk.Run("orbweave keys token keys --output spare.token");
             std::smatch number;
             ASSERT_TRUE(std::regex_search(made, number, std::regex("join token ([0-9a-f]{32})")));
             walk.Means("DIGITS", number[1]);
           }},
      {.command = "orbweave submit",
       .after = [&] { EXPECT_TRUE(std::filesystem::exists(walk / "model/report.html")); }},
      {.command = "orbweave keys revoke keys node7",
       .before = [&] { (void)walk.Run("orbweave keys add keys worker node7"); }},
      {.command = "scp -p keys/coordinator/revoked", .after = [&] {
         const testing::CommandOutcome refused = testing::RunCommand({ORBWEAVE_BINARY,
                                                                      "work",
                                                                      "--join",
                                                                      "localhost:" + port,
                                                                      "--tls",
                                                                      walk / "keys/node7"});
         EXPECT_EQ(refused.exit_code, 2) << refused.err;
       }}};
  walk.Follow(kDocs + "security.md", asides, {});
}

}  // namespace
}  // namespace orbweave::docs
