// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/http_post.h"

// One thread runs it all: no fences are needed, which ThreadSanitizer does not know.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK

#include <fcntl.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;

constexpr uint64_t kMostOfAnAnswer_bytes = 65536;

/// One request and its answer.
class Exchange {
 public:
  Exchange(const HttpUrl& url, std::string_view content_type, std::string body)
      : request_(http::verb::post, url.target, 11) {
    request_.set(http::field::host, url.Authority());
    request_.set(http::field::content_type,
                 boost::beast::string_view(content_type.data(), content_type.size()));
    request_.set(http::field::connection, "close");
    request_.body() = std::move(body);
    request_.prepare_payload();
    parser_.body_limit(kMostOfAnAnswer_bytes);
    Resolve(url);
  }

  /// What there is after `timeout_s` at most.
  absl::StatusOr<PostAnswer> Run(double timeout_s) {
    context_.run_for(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(timeout_s)));
    if (!is_over_) return absl::UnavailableError(absl::StrCat("no answer for ", timeout_s, " s"));
    if (error_) return absl::UnavailableError(error_.message());
    return PostAnswer{static_cast<int>(parser_.get().result_int()), parser_.get().body()};
  }

 private:
  bool GoesOn(const error_code& error) {
    error_ = error;
    is_over_ = static_cast<bool>(error);
    return !is_over_;
  }
  void Resolve(const HttpUrl& url) {
    resolver_.async_resolve(
        url.host, url.port, [this](const error_code& error, const tcp::resolver::results_type& at) {
          if (GoesOn(error)) Connect(at);
        });
  }
  void Connect(const tcp::resolver::results_type& at) {
    asio::async_connect(socket_, at, [this](const error_code& error, const tcp::endpoint&) {
      if (GoesOn(error)) Write();
    });
  }
  void Write() {
    ::fcntl(socket_.native_handle(), F_SETFD, FD_CLOEXEC);
    http::async_write(socket_, request_, [this](const error_code& error, size_t) {
      if (GoesOn(error)) ReadHeader();
    });
  }
  void ReadHeader() {
    http::async_read_header(socket_, buffer_, parser_, [this](const error_code& error, size_t) {
      if (!GoesOn(error)) return;
      // Beast 1.74 holds a length that a response states against no limit.
      const bool is_long = parser_.content_length().value_or(0) > kMostOfAnAnswer_bytes;
      if (GoesOn(is_long ? http::make_error_code(http::error::body_limit) : error)) Read();
    });
  }
  void Read() {
    http::async_read(socket_, buffer_, parser_, [this](const error_code& error, size_t) {
      (void)GoesOn(error);
      is_over_ = true;
    });
  }

  http::request<http::string_body> request_;
  http::response_parser<http::string_body> parser_;
  boost::beast::flat_buffer buffer_;
  error_code error_;
  bool is_over_ = false;
  asio::io_context context_{1};  ///< after what its handlers use
  tcp::resolver resolver_{context_};
  tcp::socket socket_{context_};
};

}  // namespace

absl::StatusOr<PostAnswer> HttpPost(const HttpUrl& url,
                                    std::string_view content_type,
                                    std::string body,
                                    double timeout_s) {
  return Exchange(url, content_type, std::move(body)).Run(timeout_s);
}

}  // namespace orbweave
