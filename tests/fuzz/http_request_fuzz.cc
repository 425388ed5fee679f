// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/http_server.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"
#include "tests/support/tcp_talk.h"

namespace orbweave {
namespace {

HttpServer& Server() {
  static const auto server = HttpServer::Start("127.0.0.1:0", {}, [](std::string_view path) {
    ORBWEAVE_CHECK(path.starts_with('/') && path.find('?') == std::string_view::npos);
    return std::optional<HttpPage>(HttpPage{.body = "page"});
  });
  return **server;
}

}  // namespace
}  // namespace orbweave

FUZZ_TARGET(http_request) {
  orbweave::testing::TcpTalk talk(orbweave::Server().address());
  talk.Say(orbweave::BytesOf(data, size));
  talk.EndSaying();
  const std::string answer = talk.HearAll();
  ORBWEAVE_CHECK(answer.empty() || answer.starts_with("HTTP/1."));
  ORBWEAVE_CHECK(!talk.IsOpen());  // who has nothing more to say is not waited for
}
