// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/http_client.h"

#ifdef ORBWEAVE_S3

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "objects/curl_library.h"

namespace orbweave {
namespace {

constexpr size_t kMostOfRefusal = size_t{64} << 10;
/// A list of a thousand objects has a few hundred kilobytes.
constexpr size_t kMostOfAnswer = size_t{64} << 20;
/// Less than this much in a second is a stall.
constexpr long kStallBytes = 1024;
/// Idle handles that are kept, each with its connections.
constexpr size_t kMostIdle = 16;

/// A call on its way: what libcurl's callbacks are given.
struct Exchange {
  const HttpCall& call;
  HttpAnswer answer{};
  std::string_view rest{};  ///< of the piece that is being sent
  absl::Status error{};     ///< of `next` or `take`
};

size_t TakeHeader(char* data, size_t size, size_t count, void* user) {
  Exchange& exchange = *static_cast<Exchange*>(user);
  const std::string line(data, size * count);
  if (line.starts_with("HTTP/")) {
    exchange.answer = {};
    const size_t space = std::min(line.find(' '), line.size());
    exchange.answer.status = std::atoi(line.c_str() + space);
  } else if (const size_t colon = line.find(':'); colon != std::string::npos) {
    exchange.answer.headers[absl::AsciiStrToLower(line.substr(0, colon))] =
        std::string(absl::StripAsciiWhitespace(line.substr(colon + 1)));
  }
  return size * count;
}

size_t TakeBody(char* data, size_t size, size_t count, void* user) {
  Exchange& exchange = *static_cast<Exchange*>(user);
  const std::string_view piece(data, size * count);
  HttpAnswer& answer = exchange.answer;
  if (answer.IsSuccess() && exchange.call.take) {
    exchange.error = exchange.call.take(piece);
    return exchange.error.ok() ? piece.size() : CURL_WRITEFUNC_ERROR;
  }
  const size_t most = answer.IsSuccess() ? kMostOfAnswer : kMostOfRefusal;
  const size_t room = most - std::min(most, answer.body.size());
  if (answer.IsSuccess() && room < piece.size()) {
    exchange.error = absl::UnavailableError("the store answers with more than 64 MiB");
    return CURL_WRITEFUNC_ERROR;
  }
  answer.body += piece.substr(0, room);
  return piece.size();
}

size_t GiveBody(char* buffer, size_t size, size_t count, void* user) {
  Exchange& exchange = *static_cast<Exchange*>(user);
  if (exchange.rest.empty()) {
    const absl::StatusOr<std::string_view> piece = exchange.call.next();
    exchange.error = piece.status();
    if (!piece.ok()) return CURL_READFUNC_ABORT;
    exchange.rest = *piece;
  }
  const size_t given = std::min(size * count, exchange.rest.size());
  std::memcpy(buffer, exchange.rest.data(), given);
  exchange.rest.remove_prefix(given);
  return given;
}

/// The processes of tasks are to inherit no connection.
int CloseOnExec(void*, curl_socket_t socket, curlsocktype) {
  ::fcntl(socket, F_SETFD, FD_CLOEXEC);
  return CURL_SOCKOPT_OK;
}

std::string HostOf(const std::string& url) {
  const size_t begin = url.find("://");
  if (begin == std::string::npos) return "the server";
  return url.substr(begin + 3, url.find_first_of("/?", begin + 3) - begin - 3);
}

absl::Status ErrorOf(CURLcode code, const HttpCall& call, const char* details) {
  const std::string message = absl::StrCat(HostOf(call.url), ": ", details);
  if (code == CURLE_PEER_FAILED_VERIFICATION) return absl::FailedPreconditionError(message);
  return absl::UnavailableError(message);
}

}  // namespace

class HttpClient::Handles {
 public:
  Handles(const CurlLibrary& curl, const HttpPatience& patience)
      : curl_(curl), patience_(patience) {}
  ~Handles() {
    for (CURL* handle : idle_) curl_.easy_cleanup(handle);
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  absl::StatusOr<HttpAnswer> Do(const HttpCall& call) {
    CURL* const handle = Take();
    if (handle == nullptr) return absl::ResourceExhaustedError("libcurl gives no more handles");
    Exchange exchange{.call = call};
    std::array<char, CURL_ERROR_SIZE> details{};
    curl_slist* const headers = HeadersOf(call);
    SetUp(handle, exchange, headers, details.data());
    const CURLcode code = curl_.easy_perform(handle);
    curl_.slist_free_all(headers);
    Give(handle);
    if (!exchange.error.ok()) return exchange.error;
    if (code == CURLE_OK) return std::move(exchange.answer);
    return ErrorOf(code, call, details[0] != '\0' ? details.data() : curl_.easy_strerror(code));
  }

 private:
  CURL* Take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return curl_.easy_init();
    CURL* const handle = idle_.back();
    idle_.pop_back();
    return handle;
  }

  void Give(CURL* handle) {
    curl_.easy_reset(handle);  // its connections stay
    const std::lock_guard lock(mutex_);
    if (idle_.size() < kMostIdle) {
      idle_.push_back(handle);
    } else {
      curl_.easy_cleanup(handle);
    }
  }

  curl_slist* HeadersOf(const HttpCall& call) const {
    // Without the wait for a server that does not say "100 Continue".
    curl_slist* headers = curl_.slist_append(nullptr, "Expect:");
    for (const std::string& header : call.headers)
      headers = curl_.slist_append(headers, header.c_str());
    return headers;
  }

  void SetUp(CURL* handle, Exchange& exchange, curl_slist* headers, char* details) const {
    const HttpCall& call = exchange.call;
    const auto set = [&](CURLoption option, auto value) {
      (void)curl_.easy_setopt(handle, option, value);
    };
    set(CURLOPT_URL, call.url.c_str());
    set(CURLOPT_PROTOCOLS_STR, "http,https");
    set(CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_1_1));
    set(CURLOPT_NOSIGNAL, 1L);
    set(CURLOPT_PATH_AS_IS, 1L);
    set(CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(1000.0 * patience_.connect_s));
    set(CURLOPT_LOW_SPEED_LIMIT, kStallBytes);
    set(CURLOPT_LOW_SPEED_TIME, std::max(1L, static_cast<long>(patience_.stall_s)));
    set(CURLOPT_SOCKOPTFUNCTION, &CloseOnExec);
    set(CURLOPT_ERRORBUFFER, details);
    set(CURLOPT_HTTPHEADER, headers);
    set(CURLOPT_HEADERFUNCTION, &TakeHeader);
    set(CURLOPT_HEADERDATA, &exchange);
    set(CURLOPT_WRITEFUNCTION, &TakeBody);
    set(CURLOPT_WRITEDATA, &exchange);
    set(CURLOPT_BUFFERSIZE, static_cast<long>(kPieceBytes));
    if (call.next) {
      set(CURLOPT_UPLOAD, 1L);
      set(CURLOPT_READFUNCTION, &GiveBody);
      set(CURLOPT_READDATA, &exchange);
      set(CURLOPT_INFILESIZE_LARGE, static_cast<curl_off_t>(call.body_bytes));
      set(CURLOPT_UPLOAD_BUFFERSIZE, static_cast<long>(kPieceBytes));
    }
    if (call.method == "HEAD") set(CURLOPT_NOBODY, 1L);
    set(CURLOPT_CUSTOMREQUEST, call.method.c_str());
  }

  const CurlLibrary& curl_;
  const HttpPatience patience_;
  std::mutex mutex_;
  std::vector<CURL*> idle_;
};

absl::StatusOr<std::unique_ptr<HttpClient>> HttpClient::Make(const HttpPatience& patience) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CurlLibrary* const curl, LoadCurl());
  return std::unique_ptr<HttpClient>(new HttpClient(std::make_unique<Handles>(*curl, patience)));
}

absl::StatusOr<HttpAnswer> HttpClient::Do(const HttpCall& call) { return handles_->Do(call); }

}  // namespace orbweave

#else  // ORBWEAVE_S3

namespace orbweave {

class HttpClient::Handles {};

absl::StatusOr<std::unique_ptr<HttpClient>> HttpClient::Make(const HttpPatience&) {
  return absl::FailedPreconditionError(
      "this orbweave was built without object stores (ORBWEAVE_S3, which needs "
      "libcurl4-openssl-dev)");
}

absl::StatusOr<HttpAnswer> HttpClient::Do(const HttpCall&) {
  return absl::FailedPreconditionError("built without object stores");
}

}  // namespace orbweave

#endif  // ORBWEAVE_S3

namespace orbweave {

HttpClient::HttpClient(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}

HttpClient::~HttpClient() = default;

std::string HttpAnswer::Header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? std::string() : found->second;
}

}  // namespace orbweave
