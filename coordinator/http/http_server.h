// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

/// What is answered to GET of a path.
struct HttpPage {
  int status = 200;
  std::string content_type = "text/plain; charset=utf-8";
  std::string body{};
};

/// The page at a path, which begins with '/' and is without its query; nothing: there is none.
/// Called by one thread.
using HttpPageLookup = std::function<std::optional<HttpPage>(std::string_view path)>;

struct HttpServerOptions {
  bool is_open = false;           ///< to other machines, under whatever name they know it by
  double timeout_s = 10.0;        ///< for a request to come, and for an answer to be taken
  uint32_t max_connections = 64;  ///< further ones are told 503 and closed
  uint32_t max_header_bytes = 16384;
};

/// Serves pages over HTTP/1.1 until destroyed: GET and HEAD, no bodies, neither encrypted nor
/// authenticated. One thread does it all; who reads slowly holds up nobody but itself.
///   400 malformed, 404 no such page, 405 another method, 413 a body, 421 a Host that is not on the
///   list (http_host.h), 431 too long a header, 503 too many connections
class HttpServer {
 public:
  /// `address`: host:port; port 0 lets the system choose. InvalidArgument: another form, or others
  /// could reach it and it is not to be open. Unavailable: taken, or not ours to use.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<HttpServer>> Start(
      const std::string& address, const HttpServerOptions& options, HttpPageLookup find_page);
  /// Connections are closed as they are.
  ~HttpServer();

  /// With the port that was chosen.
  [[nodiscard]] const std::string& address() const;

 private:
  class Loop;
  explicit HttpServer(std::unique_ptr<Loop> loop);

  std::unique_ptr<Loop> loop_;
};

}  // namespace orbweave
