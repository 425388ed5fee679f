// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A coordinator that is found through a file and known by its fleet, wherever an engine has put it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/pipeline/build_version.h"
#include "security/secret_file.h"
#include "tests/support/tls_server.h"
#include "worker/coordinator_address.h"
#include "worker/grpc_channel.h"
#include "worker/grpc_enrollment_client.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;
using testing::TlsServer;

void Write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

std::string AnnouncedIn(const std::string& path, const std::string& address) {
  Write(path, AnnouncementToText({.address = address, .fleet = "city"}));
  return "@" + path;
}

/// Keys of `server`'s coordinator that name a host it is not reached by: nobody who asks for its
/// address takes them.
void MoveElsewhere(TlsServer& server) {
  const std::string store = server.keys();
  ORBWEAVE_CHECK(AddKeys(store,
                         {.role = Role::kCoordinator, .name = "moved", .hosts = {"elsewhere"}},
                         UnixNow())
                     .ok());
  for (const char* file : {"own.crt", "own.key"}) {
    fs::copy_file(store + "/moved/" + file,
                  store + "/coordinator/" + file,
                  fs::copy_options::overwrite_existing);
  }
  server.Restart();
}

TEST(Announcement, IsReadAsItWasWritten) {
  const Announcement written{"host:7000", "city", "0.1.0"};
  EXPECT_EQ(*AnnouncementFromText(AnnouncementToText(written)), written);
  for (const char* text :
       {"", "{}", "[]", "host:7000", "{\"address\": 7000}", "{\"address\": \"\"}"})
    EXPECT_FALSE(AnnouncementFromText(text).ok()) << text;
}

TEST(FindCoordinator, LooksIntoTheFileEachTime) {
  const testing::TemporaryFolder folder;
  const std::string path = folder / "coordinator.json";
  EXPECT_EQ(FindCoordinator("host:1")->address, "host:1");
  EXPECT_EQ(FindCoordinator("host:1")->known_by, KnownBy::kHost);
  EXPECT_TRUE(absl::IsUnavailable(FindCoordinator("@" + path).status())) << "not there yet";
  Write(path, "{");
  EXPECT_TRUE(absl::IsUnavailable(FindCoordinator("@" + path).status()));
  for (const char* address : {"one:1", "two:2"}) {
    EXPECT_EQ(FindCoordinator(AnnouncedIn(path, address))->address, address);
    EXPECT_EQ(FindCoordinator("@" + path)->known_by, KnownBy::kFleet);
  }
}

TEST(AnnouncedCoordinator, IsKnownByItsFleetAndNotByItsHost) {
  TlsServer server;
  MoveElsewhere(server);
  EXPECT_TRUE(absl::IsUnavailable(server.As("client")->ListJobs().status()))
      << "its certificate does not name this host";
  const std::string file = AnnouncedIn(server.folder() / "file", server.address());
  GrpcCoordinatorClient client(file, {.tls_folder = server.keys() + "/client"});
  const auto jobs = client.ListJobs();
  EXPECT_TRUE(jobs.ok()) << jobs.status();
}

TEST(AnnouncedCoordinator, GivesCertificatesForTokens) {
  TlsServer server;
  MoveElsewhere(server);
  const std::string file = AnnouncedIn(server.folder() / "file", server.address());
  ASSERT_TRUE(WriteJoinToken(server.keys(), server.folder() / "token", UnixNow() + 60).ok());
  const TlsFolder fresh{server.folder() / "fresh"};
  const std::string token = *ReadSecretFile(server.folder() / "token");
  const absl::Status enrolled = Enroll(file, token, "host", fresh);
  ASSERT_TRUE(enrolled.ok()) << enrolled;
  EXPECT_TRUE(RenewCertificate(file, fresh).ok());
}

TEST(AnnouncedCoordinator, OfAnotherAuthorityIsRefused) {
  TlsServer server;
  TlsServer posing;
  const std::string file = AnnouncedIn(server.folder() / "file", posing.address());
  GrpcCoordinatorClient client(file, {.tls_folder = server.keys() + "/client"});
  EXPECT_FALSE(client.ListJobs().ok());
}

TEST(AnnouncedCoordinator, OfNoFleetIsRefused) {
  TlsServer server;
  const std::string authority = *ReadSecretFile(server.keys() + "/client/ca.crt");
  const auto answers = [&](const std::string& fleet) {
    const auto channel = OpenChannelAsStranger(server.address(), authority, fleet);
    return channel->WaitForConnected(std::chrono::system_clock::now() + std::chrono::seconds(5));
  };
  EXPECT_TRUE(answers("city"));
  EXPECT_FALSE(answers("village")) << "the same authority, another fleet";
}

TEST(AnnouncedCoordinator, IsFollowedToWhereItIsStartedAgain) {
  auto first = std::make_unique<TlsServer>();
  const testing::TemporaryFolder folder;
  const std::string keys = folder / "keys";
  fs::copy(first->keys(), keys, fs::copy_options::recursive);
  const std::string file = AnnouncedIn(folder / "file", first->address());
  GrpcCoordinatorClient client(file, {.tls_folder = keys + "/client"});
  ASSERT_TRUE(client.ListJobs().ok());
  SteadyClock clock;
  const auto second = *Coordinator::Open({.state_dir = folder / "state"}, clock);
  const auto server =
      *GrpcServer::Start(*second, "127.0.0.1:0", {.tls_folder = keys + "/coordinator"});
  ASSERT_NE(server->address(), first->address());
  first.reset();
  AnnouncedIn(folder / "file", server->address());
  EXPECT_TRUE(testing::WaitUntil([&] { return client.ListJobs().ok(); }, 20.0));
  second->BeginShutdown();
}

}  // namespace
}  // namespace orbweave
