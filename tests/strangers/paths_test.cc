// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a client may name on the coordinator's machine: messages as a hostile client would send
// them.

#include <gtest/gtest.h>

#include "orbweave/v1/coordinator.grpc.pb.h"
#include "tests/support/tls_server.h"
#include "worker/grpc_channel.h"

namespace orbweave {
namespace {

using testing::TlsServer;

class Paths : public ::testing::Test {
 protected:
  Paths() {
    testing::WriteAll(files_ / "root/street/a.jpg", "pixels");
    testing::WriteAll(files_ / "secret", "pixels");  // the same bytes: only the way is wrong
    std::filesystem::create_symlink(files_ / "secret", files_ / "root/link.jpg");
  }

  grpc::StatusCode Link(const std::string& root, const std::string& path) {
    v1::LinkFileRequest request;
    const Digest digest = DigestOf("pixels");
    request.set_digest(digest.bytes.data(), digest.bytes.size());
    request.set_root(root);
    request.set_path(path);
    grpc::ClientContext context;
    v1::Empty reply;
    return stub_->LinkFile(&context, request, &reply).error_code();
  }

  testing::TemporaryFolder files_;
  TlsServer server_{{.roots = {{"data", files_ / "root"}}}};
  std::unique_ptr<v1::Coordinator::Stub> stub_ =
      v1::Coordinator::NewStub(OpenChannel(server_.address(), server_.keys() + "/client"));
};

TEST_F(Paths, BeneathARootAreTaken) {
  EXPECT_EQ(Link("data", "street/a.jpg"), grpc::StatusCode::OK);
  EXPECT_EQ(*server_.As("node")->Get(DigestOf("pixels")), "pixels");
}

TEST_F(Paths, ThatLeadOutOfItAreRefused) {
  for (const std::string& path : {std::string("../secret"),
                                  std::string("street/../../secret"),
                                  files_ / "secret",
                                  files_ / "root/street/a.jpg",
                                  std::string("link.jpg")}) {
    EXPECT_EQ(Link("data", path), grpc::StatusCode::PERMISSION_DENIED) << path;
  }
  EXPECT_EQ(Link("data", std::string("street/a.jpg\0", 13)), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(Link("data", ""), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_TRUE(absl::IsNotFound(server_.As("node")->Get(DigestOf("pixels")).status()));
}

TEST_F(Paths, BeneathNoRootAreRefused) {
  EXPECT_EQ(Link("", files_ / "secret"), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(Link("other", "street/a.jpg"), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(Link("..", "secret"), grpc::StatusCode::NOT_FOUND);
}

TEST_F(Paths, AreNamedByTheClientWhereItsOwnRootSays) {
  GrpcCoordinatorClient client(
      server_.address(),
      {.tls_folder = server_.keys() + "/client", .roots = {{"data", files_ / "root"}}});
  EXPECT_TRUE(client.LinkFile(DigestOf("pixels"), files_ / "root/street/../street/a.jpg").ok());
  EXPECT_TRUE(absl::IsNotFound(client.LinkFile(DigestOf("pixels"), files_ / "secret")));
  EXPECT_TRUE(absl::IsNotFound(client.LinkFile(DigestOf("pixels"), files_ / "root2/a.jpg")));
}

}  // namespace
}  // namespace orbweave
