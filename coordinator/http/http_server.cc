// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/http_server.h"

// One thread runs it all: no fences are needed, which ThreadSanitizer does not know.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <limits>
#include <thread>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "coordinator/http/http_host.h"
#include "coordinator/listen_address.h"

namespace orbweave {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;
using Response = http::response<http::string_body>;
using Parser = http::request_parser<http::empty_body>;

/// How long a connection that is over is read to its end: closed with bytes unread, it would take
/// the answer back.
constexpr double kFarewell_s = 1.0;
/// After a connection could not be taken, as when there are no file descriptors left.
constexpr double kPause_s = 0.1;

constexpr std::string_view kTooMany =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

std::chrono::steady_clock::duration Seconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds));
}

std::string_view View(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// What a server was told, as its connections need it.
struct HttpHouse {
  HttpServerOptions options{};
  HttpPageLookup find_page{};
  std::string host{};  ///< that is listened on
};

HttpPage Refusal(http::status status) {
  const auto number = static_cast<int>(status);
  return {.status = number,
          .body = absl::StrCat(number, " ", std::string(http::obsolete_reason(status)), "\n")};
}

bool IsReadOnly(http::verb method) {
  return method == http::verb::get || method == http::verb::head;
}

bool MayAsk(const Parser& parser, const HttpHouse& house) {
  return house.options.is_open || NamesThisHost(View(parser.get()[http::field::host]), house.host);
}

/// The answer to a request whose header is whole.
HttpPage AnswerTo(const Parser& parser, const HttpHouse& house) {
  const auto& request = parser.get();
  const size_t hosts = request.count(http::field::host);
  const std::string_view target = View(request.target());
  const bool is_well_formed =
      target.starts_with('/') && hosts <= 1 && (hosts == 1 || request.version() < 11);
  if (!is_well_formed) return Refusal(http::status::bad_request);
  if (!MayAsk(parser, house)) return Refusal(http::status::misdirected_request);
  if (!IsReadOnly(request.method())) return Refusal(http::status::method_not_allowed);
  if (!parser.is_done()) return Refusal(http::status::payload_too_large);
  std::optional<HttpPage> page = house.find_page(target.substr(0, target.find('?')));
  return page ? *std::move(page) : Refusal(http::status::not_found);
}

/// The answer to what was no request; nothing: nobody waits for one.
std::optional<HttpPage> AnswerTo(const error_code& error) {
  static const auto& kMalformed = http::make_error_code(http::error::bad_target).category();
  if (error.category() != kMalformed || error == http::error::end_of_stream ||
      error == http::error::partial_message) {
    return std::nullopt;
  }
  const bool is_long = error == http::error::header_limit || error == http::error::buffer_overflow;
  return Refusal(is_long ? http::status::request_header_fields_too_large
                         : http::status::bad_request);
}

Response ResponseOf(HttpPage page, unsigned version, bool keeps_alive) {
  Response response(static_cast<http::status>(page.status), version);
  response.set(http::field::content_type, page.content_type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  if (response.result() == http::status::method_not_allowed)
    response.set(http::field::allow, "GET, HEAD");
  response.keep_alive(keeps_alive);
  response.body() = std::move(page.body);
  response.prepare_payload();
  return response;
}

/// A connection; it lives as long as something of it is under way.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, const HttpHouse& house, uint32_t& open)
      : house_(house),
        open_(open),
        stream_(std::move(socket)),
        buffer_(house.options.max_header_bytes) {
    ++open_;
  }
  ~HttpConnection() { --open_; }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void ReadRequest() {
    serializer_.reset();
    response_ = {};
    parser_.emplace();
    parser_->header_limit(house_.options.max_header_bytes);
    parser_->body_limit(std::numeric_limits<uint64_t>::max());  // it is not read
    stream_.expires_after(Seconds(house_.options.timeout_s));
    http::async_read_header(
        stream_, buffer_, *parser_, [self = shared_from_this()](const error_code& error, size_t) {
          self->TakeRequest(error);
        });
  }

 private:
  void TakeRequest(const error_code& error) {
    if (!error) {
      const auto& request = parser_->get();
      const bool keeps_alive = request.keep_alive() && parser_->is_done();
      Answer(ResponseOf(AnswerTo(*parser_, house_), request.version(), keeps_alive),
             request.method() == http::verb::head);
    } else if (std::optional<HttpPage> refusal = AnswerTo(error)) {
      Answer(ResponseOf(*std::move(refusal), 11, false), false);
    }
  }

  void Answer(Response response, bool is_header_only) {
    response_ = std::move(response);
    serializer_.emplace(response_);
    const auto then = [self = shared_from_this()](const error_code& error, size_t) {
      if (error) return;
      if (self->response_.keep_alive()) {
        self->ReadRequest();
      } else {
        self->TakeLeave();
      }
    };
    stream_.expires_after(Seconds(house_.options.timeout_s));
    if (is_header_only) {
      http::async_write_header(stream_, *serializer_, then);
    } else {
      http::async_write(stream_, *serializer_, then);
    }
  }

  void TakeLeave() {
    error_code gone;
    stream_.socket().shutdown(tcp::socket::shutdown_send, gone);
    if (gone) return;
    stream_.expires_after(Seconds(std::min(kFarewell_s, house_.options.timeout_s)));
    ReadToTheEnd();
  }

  void ReadToTheEnd() {
    stream_.async_read_some(asio::buffer(rest_),
                            [self = shared_from_this()](const error_code& error, size_t) {
                              if (!error) self->ReadToTheEnd();
                            });
  }

  const HttpHouse& house_;
  uint32_t& open_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  Response response_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  std::array<char, 1024> rest_{};
};

absl::Status CheckAddress(const std::string& address, bool is_open) {
  if (absl::StartsWith(address, "unix:")) {
    return absl::InvalidArgumentError("HTTP is served on host:port, not on a unix socket");
  }
  ORBWEAVE_RETURN_IF_ERROR(CheckListenAddress(address, Wire::kEncrypted));  // its form
  if (is_open || CheckListenAddress(address, Wire::kPlain).ok()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("refusing to serve HTTP on ",
                   address,
                   ": it is neither encrypted nor authenticated, so on a loopback address "
                   "(127.0.0.1:port) only, unless --http-open says that others may read it"));
}

absl::Status Unusable(const std::string& address, const error_code& error) {
  return absl::UnavailableError(
      absl::StrCat("cannot serve HTTP on ", address, ": ", error.message()));
}

absl::StatusOr<tcp::endpoint> Resolve(asio::io_context& context, const std::string& address) {
  const size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  error_code error;
  const auto found = tcp::resolver(context).resolve(
      host, address.substr(colon + 1), tcp::resolver::passive, error);
  if (error) return Unusable(address, error);
  return found.begin()->endpoint();
}

void CloseOnExec(int socket) { ::fcntl(socket, F_SETFD, FD_CLOEXEC); }

}  // namespace

/// The thread and what it does.
class HttpServer::Loop {
 public:
  explicit Loop(HttpHouse house) : house_(std::move(house)) {}
  ~Loop() { context_.stop(); }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  absl::Status Listen(const std::string& address) {
    ORBWEAVE_ASSIGN_OR_RETURN(const tcp::endpoint endpoint, Resolve(context_, address));
    if (!house_.options.is_open && !endpoint.address().is_loopback()) {
      return absl::InvalidArgumentError(absl::StrCat(address, " is no loopback address"));
    }
    error_code error;
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(tcp::acceptor::max_listen_connections, error);
    const uint16_t port = error ? 0 : acceptor_.local_endpoint(error).port();
    if (error) return Unusable(address, error);
    CloseOnExec(acceptor_.native_handle());
    house_.host = address.substr(0, address.rfind(':'));
    address_ = absl::StrCat(house_.host, ":", port);
    return absl::OkStatus();
  }

  void Run() {
    Accept();
    thread_ = std::jthread([this] { context_.run(); });
  }

  [[nodiscard]] const std::string& address() const { return address_; }

 private:
  void Accept() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      if (error) return Pause();
      Take(std::move(socket));
      Accept();
    });
  }

  void Pause() {
    timer_.expires_after(Seconds(kPause_s));
    timer_.async_wait([this](const error_code&) { Accept(); });
  }

  void Take(tcp::socket socket) {
    CloseOnExec(socket.native_handle());
    if (open_ < house_.options.max_connections) {
      std::make_shared<HttpConnection>(std::move(socket), house_, open_)->ReadRequest();
      return;
    }
    error_code gone;
    socket.non_blocking(true, gone);
    socket.send(asio::buffer(kTooMany.data(), kTooMany.size()), 0, gone);
  }

  HttpHouse house_;
  std::string address_;
  uint32_t open_ = 0;            ///< connections
  asio::io_context context_{1};  ///< after what its connections use
  tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_};
  std::jthread thread_;  ///< last: ends before what it uses
};

HttpServer::HttpServer(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}

HttpServer::~HttpServer() = default;

const std::string& HttpServer::address() const { return loop_->address(); }

absl::StatusOr<std::unique_ptr<HttpServer>> HttpServer::Start(const std::string& address,
                                                              const HttpServerOptions& options,
                                                              HttpPageLookup find_page) {
  ORBWEAVE_RETURN_IF_ERROR(CheckAddress(address, options.is_open));
  auto loop = std::make_unique<Loop>(HttpHouse{options, std::move(find_page), {}});
  ORBWEAVE_RETURN_IF_ERROR(loop->Listen(address));
  loop->Run();
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(loop)));
}

}  // namespace orbweave
