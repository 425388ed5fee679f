// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/http_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <list>
#include <thread>

#include "core/base/random.h"
#include "tests/support/command.h"
#include "tests/support/http_get.h"

namespace orbweave {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using testing::HttpGet;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using testing::TcpTalk;
using testing::WaitUntil;

constexpr size_t kLargeBytes = size_t{32} << 20;

std::optional<HttpPage> FindPage(std::string_view path) {
  if (path == "/page") return HttpPage{.body = "a page\n"};
  if (path == "/sick") return HttpPage{.status = 503, .body = "why\n"};
  if (path == "/large") return HttpPage{.body = std::string(kLargeBytes, 'x')};
  return std::nullopt;
}

class HttpServerTest : public ::testing::Test {
 protected:
  void Start(const HttpServerOptions& options = {}, const std::string& address = "127.0.0.1:0") {
    auto started = HttpServer::Start(address, options, FindPage);
    ASSERT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
  }

  /// The answer to these bytes, after which nothing is said.
  [[nodiscard]] std::string Ask(const std::string& bytes) const {
    TcpTalk talk(server_->address());
    talk.Say(bytes);
    talk.EndSaying();
    return talk.HearAll();
  }
  /// The answer to a request with these lines beside its Host.
  [[nodiscard]] std::string Request(const std::string& line, const std::string& fields = "") const {
    return Ask(line + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "Connection: close\r\n\r\n");
  }
  [[nodiscard]] std::string Get() const { return HttpGet(server_->address(), "/page"); }

  std::unique_ptr<HttpServer> server_;
};

constexpr char kOk[] = "HTTP/1.1 200 OK\r\n";
constexpr char kGet[] = "GET /page HTTP/1.1\r\nHost: localhost\r\n\r\n";
constexpr char kGetLarge[] = "GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n";
constexpr char kGetSick[] = "GET /sick HTTP/1.1\r\nHost: localhost\r\n\r\n";
constexpr char kPage[] = "a page\n";

TEST_F(HttpServerTest, AnswersWithThePage) {
  Start();
  const std::string answer = Get();
  EXPECT_THAT(answer, StartsWith(kOk));
  EXPECT_THAT(answer, HasSubstr("\r\nContent-Type: text/plain; charset=utf-8\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\nContent-Length: 7\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\nCache-Control: no-store\r\n"));
  EXPECT_THAT(answer, HasSubstr("\r\nConnection: close\r\n"));
  EXPECT_TRUE(answer.ends_with("\r\n\r\na page\n"));
}

TEST_F(HttpServerTest, AnswersHeadAsGetWithoutTheBody) {
  Start();
  std::string get = Request("GET /page");
  const std::string head = Request("HEAD /page");
  get.resize(get.size() - std::string(kPage).size());
  EXPECT_EQ(head, get);
}

TEST_F(HttpServerTest, FindsAPageWhateverItsQuery) {
  Start();
  EXPECT_THAT(Request("GET /page?name=value"), StartsWith(kOk));
  EXPECT_THAT(Request("GET /page?"), StartsWith(kOk));
}

TEST_F(HttpServerTest, SaysWhatAPageSays) {
  Start();
  const std::string answer = Request("GET /sick");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 503 Service Unavailable\r\n"));
  EXPECT_TRUE(answer.ends_with("\r\n\r\nwhy\n"));
}

TEST_F(HttpServerTest, KnowsNoOtherPath) {
  Start();
  for (const std::string path :
       {"/", "/pages", "/page/", "//page", "/./page", "/PAGE", "/%70age", "/..", "/page;x"}) {
    EXPECT_THAT(Request("GET " + path), StartsWith("HTTP/1.1 404 Not Found\r\n")) << path;
  }
}

TEST_F(HttpServerTest, RefusesOtherMethodsAndNamesThoseItTakes) {
  Start();
  for (const std::string method :
       {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "BREW", "get"}) {
    const std::string answer = Request(method + " /page");
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 405 Method Not Allowed\r\n")) << method;
    EXPECT_THAT(answer, HasSubstr("\r\nAllow: GET, HEAD\r\n")) << method;
  }
  EXPECT_THAT(Request("POST /page", "Content-Length: 3000000\r\n"), StartsWith("HTTP/1.1 405 "));
}

TEST_F(HttpServerTest, RefusesBodies) {
  Start();
  for (const std::string field : {"Content-Length: 5\r\n",
                                  "Content-Length: 99999999999\r\n",
                                  "Transfer-Encoding: chunked\r\n"}) {
    EXPECT_THAT(Request("GET /page", field), StartsWith("HTTP/1.1 413 ")) << field;
  }
  EXPECT_THAT(Request("GET /page", "Content-Length: 0\r\n"), StartsWith(kOk));
  const std::string smuggled = Ask(
      "GET /page HTTP/1.1\r\nHost: localhost\r\nContent-Length: 40\r\n\r\n" + std::string(kGet));
  EXPECT_THAT(smuggled, StartsWith("HTTP/1.1 413 "));
  EXPECT_THAT(smuggled, Not(HasSubstr(kPage))) << "what is behind it is no request";
}

TEST_F(HttpServerTest, RefusesAHostThatIsNotItsOwn) {
  Start();
  const auto ask = [this](const std::string& hosts) {
    return Ask("GET /page HTTP/1.1\r\n" + hosts + "Connection: close\r\n\r\n");
  };
  EXPECT_THAT(ask("Host: evil.example\r\n"), StartsWith("HTTP/1.1 421 Misdirected Request\r\n"));
  EXPECT_THAT(ask("Host:\r\n"), StartsWith("HTTP/1.1 421 "));
  EXPECT_THAT(ask("Host: " + server_->address() + "\r\n"), StartsWith(kOk));
  EXPECT_THAT(ask(""), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(ask("Host: localhost\r\nHost: evil.example\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(Request("GET http://evil.example/page"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(Ask("GET /page HTTP/1.0\r\n\r\n"), StartsWith("HTTP/1.0 421 "))
      << "an old client that does not say";
}

TEST_F(HttpServerTest, TakesAnyHostWhenItIsOpen) {
  Start({.is_open = true}, "0.0.0.0:0");
  const std::string port = server_->address().substr(server_->address().rfind(':'));
  TcpTalk talk("127.0.0.1" + port);
  talk.Say("GET /page HTTP/1.1\r\nHost: coordinator.example\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(talk.HearAll(), StartsWith(kOk));
}

TEST_F(HttpServerTest, RefusesWhatIsNoRequest) {
  Start();
  for (const std::string& bytes : {std::string("\r\n\r\n\r\n"),
                                   std::string("hello\r\n\r\n"),
                                   std::string("GET\r\n\r\n"),
                                   std::string("GET /page\r\n\r\n"),
                                   std::string("GET  /page HTTP/1.1\r\n\r\n"),
                                   std::string("GET /page HTTP/9.9\r\n\r\n"),
                                   std::string("GET /page HTTP/2.0\r\n\r\n"),
                                   std::string("GET /page XTTP/1.1\r\n\r\n"),
                                   std::string("GET /pa\0ge HTTP/1.1\r\n\r\n", 23),
                                   std::string("GET /page HTTP/1.1\r\n: empty\r\n\r\n"),
                                   std::string("GET /page HTTP/1.1\r\nA B: c\r\n\r\n"),
                                   std::string("GET /page HTTP/1.1\r\nContent-Length: -1\r\n\r\n"),
                                   std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"),
                                   std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11),
                                   std::string(3, '\0')}) {
    EXPECT_THAT(Ask(bytes), AnyOf(IsEmpty(), StartsWith("HTTP/1.1 400 "))) << bytes;
  }
  EXPECT_THAT(Ask("GET /page"), IsEmpty()) << "it never ended";
  EXPECT_THAT(Get(), StartsWith(kOk));
}

TEST_F(HttpServerTest, RefusesHeadersThatAreTooLong) {
  Start();
  const auto with_field_of = [this](size_t bytes) {
    return Request("GET /page", "X: " + std::string(bytes, 'x') + "\r\n");
  };
  EXPECT_THAT(with_field_of(15'000), StartsWith(kOk));
  EXPECT_THAT(with_field_of(17'000), StartsWith("HTTP/1.1 431 "));
  EXPECT_THAT(with_field_of(4'000'000), StartsWith("HTTP/1.1 431 "));
  EXPECT_THAT(Ask(std::string(100'000, 'G')),
              AnyOf(StartsWith("HTTP/1.1 431 "), StartsWith("HTTP/1.1 400 ")));
  EXPECT_THAT(Ask("GET /" + std::string(100'000, 'x')), StartsWith("HTTP/1.1 431 "));
  std::string many;
  for (int i = 0; i < 20'000; ++i) many += "A: b\r\n";
  EXPECT_THAT(Request("GET /page", many), StartsWith("HTTP/1.1 431 "));
}

TEST_F(HttpServerTest, KeepsAConnectionUnlessItIsToBeClosed) {
  Start({.timeout_s = 3600.0});
  TcpTalk talk(server_->address());
  for (int i = 0; i < 3; ++i) {
    talk.Say(kGet);
    EXPECT_THAT(talk.HearUntil(kPage), StartsWith(kOk));
  }
  talk.Say("GET /nothing HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(talk.HearUntil("Not Found\n"), StartsWith("HTTP/1.1 404 ")) << "nor for a refusal";
  talk.HearUntil("Not Found\n", 0.1);
  EXPECT_TRUE(talk.IsOpen());
  talk.Say("GET /page HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(talk.HearAll().ends_with(kPage));
  EXPECT_FALSE(talk.IsOpen());
  TcpTalk old(server_->address());
  old.Say("GET /page HTTP/1.0\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(old.HearAll().ends_with(kPage));
  EXPECT_FALSE(old.IsOpen());
}

TEST_F(HttpServerTest, AnswersRequestsThatComeAtOnceInTheirOrder) {
  Start({.timeout_s = 3600.0});
  TcpTalk talk(server_->address());
  std::string requests;
  constexpr int kRequests = 1000;
  for (int i = 0; i < kRequests; ++i) requests += i % 2 == 0 ? kGet : kGetSick;
  std::jthread saying([&] { talk.Say(requests); });
  for (int i = 0; i < kRequests; ++i) {
    ASSERT_THAT(talk.HearUntil(i % 2 == 0 ? "\r\n\r\na page\n" : "\r\n\r\nwhy\n"),
                StartsWith(i % 2 == 0 ? kOk : "HTTP/1.1 503 "))
        << i;
  }
}

TEST_F(HttpServerTest, ClosesOnWhoSaysNothingOrTooSlowly) {
  Start({.timeout_s = 0.3});
  TcpTalk silent(server_->address());
  TcpTalk idle(server_->address());
  idle.Say(kGet);
  EXPECT_THAT(idle.HearUntil(kPage), StartsWith(kOk));
  TcpTalk slow(server_->address());
  slow.Say("GET /page HTTP/1.1\r\n");
  bool is_heard = true;  // a field now and then, for ever
  for (int i = 0; is_heard && i < 1000; ++i) {
    is_heard = slow.Say("X: y\r\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(is_heard);
  EXPECT_THAT(silent.HearAll(), IsEmpty());
  EXPECT_THAT(idle.HearAll(), IsEmpty());
  EXPECT_FALSE(silent.IsOpen());
  EXPECT_FALSE(idle.IsOpen());
}

TEST_F(HttpServerTest, IsNotHeldUpByWhoReadsSlowly) {
  Start({.timeout_s = 3600.0});
  std::list<TcpTalk> slow;
  for (int i = 0; i < 3; ++i) {
    slow.emplace_back(server_->address(), 4096).Say(kGetLarge);
    EXPECT_THAT(slow.back().HearUntil("\r\n\r\n"), StartsWith(kOk));
  }
  EXPECT_THAT(Get(), StartsWith(kOk));
  EXPECT_EQ(slow.front().HearAll(1.0).find_first_not_of('x'), std::string::npos) << "goes on";
}

TEST_F(HttpServerTest, ClosesOnWhoReadsTooSlowly) {
  Start({.timeout_s = 0.3, .max_connections = 1});
  TcpTalk slow(server_->address(), 4096);
  slow.Say(kGetLarge);
  EXPECT_THAT(slow.HearUntil("\r\n\r\n"), StartsWith(kOk));
  EXPECT_TRUE(WaitUntil([this] { return Get().starts_with(kOk); }, 30.0));
}

TEST_F(HttpServerTest, TakesNoMoreConnectionsThanItMay) {
  Start({.timeout_s = 3600.0, .max_connections = 4});
  std::list<TcpTalk> talks;
  for (int i = 0; i < 4; ++i) {
    talks.emplace_back(server_->address()).Say(kGet);
    EXPECT_THAT(talks.back().HearUntil(kPage), StartsWith(kOk));
  }
  for (int i = 0; i < 100; ++i) {
    TcpTalk further(server_->address());
    EXPECT_THAT(further.HearAll(), StartsWith("HTTP/1.1 503 "));
    EXPECT_FALSE(further.IsOpen());
  }
  for (TcpTalk& talk : talks) {
    talk.Say(kGet);
    EXPECT_THAT(talk.HearUntil(kPage), StartsWith(kOk)) << "those that are there stay";
  }
  talks.pop_front();
  EXPECT_TRUE(WaitUntil([this] { return Get().starts_with(kOk); }, 30.0));
}

TEST_F(HttpServerTest, EndsAtOnceWhateverIsUnderWay) {
  Start({.timeout_s = 3600.0});
  TcpTalk silent(server_->address());
  TcpTalk halfway(server_->address());
  halfway.Say("GET /page HTTP");
  TcpTalk reading(server_->address(), 4096);
  reading.Say(kGetLarge);
  EXPECT_THAT(reading.HearUntil("\r\n\r\n"), StartsWith(kOk));
  server_.reset();
  EXPECT_THAT(silent.HearAll(), IsEmpty());
  EXPECT_THAT(halfway.HearAll(), IsEmpty());
  EXPECT_FALSE(silent.IsOpen());
}

TEST_F(HttpServerTest, ClosesAConnectionThatGoesAwayUnread) {
  Start({.max_connections = 1});
  for (int i = 0; i < 50; ++i) {
    TcpTalk gone(server_->address());
    gone.Say(kGetLarge);
  }
  EXPECT_TRUE(WaitUntil([this] { return Get().starts_with(kOk); }, 30.0));
}

/// A request with a few bytes changed, left out or said again; or bytes of no meaning at all.
std::string Mangled(Random& random) {
  static const std::vector<std::string> kWhole = {
      kGet,
      "HEAD /page?a=b HTTP/1.1\r\nHost: localhost:80\r\nConnection: close\r\n\r\n",
      "POST /page HTTP/1.1\r\nHost: [::1]\r\nTransfer-Encoding: chunked\r\n\r\n1\r\nx\r\n0\r\n\r\n",
      "GET /page HTTP/1.0\r\nHost: 127.0.0.1\r\nContent-Length: 18446744073709551615\r\n\r\n",
      "GET /page HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nUpgrade: h2c\r\n "
      "x\r\n\r\n"};
  std::string bytes;
  for (uint32_t i = 0; i < 1 + random.Index(3); ++i)
    bytes += kWhole[random.Index(static_cast<uint32_t>(kWhole.size()))];
  for (uint32_t i = 0; i < random.Index(12); ++i) {
    const size_t at = random.Index(static_cast<uint32_t>(bytes.size()));
    const size_t length = 1 + random.Index(8);
    switch (random.Index(4)) {
      case 0:
        bytes[at] = static_cast<char>(random.Next());
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at / 2, length));
        break;
      default:
        bytes.insert(at, length * 100, bytes[at]);
        break;
    }
    if (bytes.empty()) break;
  }
  if (random.Index(8) > 0) return bytes;
  for (char& byte : bytes) byte = static_cast<char>(random.Next());
  return bytes;
}

TEST_F(HttpServerTest, SurvivesStrangersBytes) {
  Start();
  Random random(7);
  for (int i = 0; i < 3000; ++i) {
    TcpTalk talk(server_->address());
    talk.Say(Mangled(random));
    if (random.Index(3) == 0) continue;  // hangs up
    talk.EndSaying();
    EXPECT_THAT(talk.HearAll(), AnyOf(IsEmpty(), StartsWith("HTTP/1.")));
  }
  EXPECT_THAT(Get(), StartsWith(kOk));
}

TEST(HttpServer, RefusesAnAddressThatOthersCanReachUnlessItIsToBeOpen) {
  for (const std::string address :
       {"0.0.0.0:0", "[::]:0", ":0", "unix:/tmp/s", "nonsense", "127.0.0.1:x"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(HttpServer::Start(address, {}, FindPage).status()))
        << address;
  }
  EXPECT_THAT(std::string(HttpServer::Start("0.0.0.0:0", {}, FindPage).status().message()),
              HasSubstr("--http-open"));
  EXPECT_TRUE(HttpServer::Start("0.0.0.0:0", {.is_open = true}, FindPage).ok());
  for (const std::string address : {"unix:/tmp/s", "nonsense"}) {
    EXPECT_TRUE(
        absl::IsInvalidArgument(HttpServer::Start(address, {.is_open = true}, FindPage).status()))
        << address;
  }
}

TEST(HttpServer, SaysSoWhereAnAddressIsTakenOrNotOurs) {
  const auto server = HttpServer::Start("127.0.0.1:0", {}, FindPage);
  ASSERT_TRUE(server.ok()) << server.status();
  const absl::Status taken = HttpServer::Start((*server)->address(), {}, FindPage).status();
  EXPECT_TRUE(absl::IsUnavailable(taken));
  EXPECT_THAT(std::string(taken.message()), HasSubstr((*server)->address()));
  EXPECT_TRUE(
      absl::IsUnavailable(HttpServer::Start("192.0.2.1:0", {.is_open = true}, FindPage).status()))
      << "no address of this machine";
}

TEST(HttpServer, ServesOnAPortThatWasServedBefore) {
  auto server = HttpServer::Start("127.0.0.1:0", {}, FindPage);
  ASSERT_TRUE(server.ok()) << server.status();
  const std::string address = (*server)->address();
  EXPECT_THAT(HttpGet(address, "/page"), StartsWith(kOk));
  server->reset();
  server = HttpServer::Start(address, {}, FindPage);
  ASSERT_TRUE(server.ok()) << server.status();
  EXPECT_THAT(HttpGet(address, "/page"), StartsWith(kOk));
}

}  // namespace
}  // namespace orbweave
