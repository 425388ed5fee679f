// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/pipeline/blob_access.h"

namespace orbweave {

/// One request over HTTP.
struct HttpCall {
  std::string method = "GET";
  std::string url{};
  std::vector<std::string> headers{};  ///< "name: value"
  uint64_t body_bytes = 0;             ///< of what `next` gives
  NextPiece next{};                    ///< empty: no body
  /// Takes the body of an answer of success (200 to 299). Empty: it comes with the answer.
  TakePiece take{};
};

struct HttpAnswer {
  int status = 0;
  std::map<std::string, std::string> headers{};  ///< names in lower case
  std::string body{};  ///< that was not taken; of an answer that is no success at most 64 KiB

  [[nodiscard]] bool IsSuccess() const { return status >= 200 && status < 300; }
  /// Empty: there is none.
  [[nodiscard]] std::string Header(const std::string& name) const;
};

struct HttpPatience {
  double connect_s = 10.0;
  double stall_s = 30.0;  ///< with less than a kilobyte a second
};

/// Calls over HTTP/1.1 and TLS by libcurl, which is loaded when the first client is made;
/// connections are kept for the calls that follow. Redirections are not followed. Thread-safe.
class HttpClient {
 public:
  /// FailedPrecondition: this program was built without it, or libcurl.so.4 is not installed.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<HttpClient>> Make(
      const HttpPatience& patience = {});
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Whatever the server answers is OK. Unavailable: it did not, or not to the end; no message says
  /// more of the URL than its host. FailedPrecondition: its certificate is not taken. Errors of
  /// `next` and `take`.
  [[nodiscard]] absl::StatusOr<HttpAnswer> Do(const HttpCall& call);

 private:
  class Handles;
  explicit HttpClient(std::unique_ptr<Handles> handles);

  std::unique_ptr<Handles> handles_;
};

}  // namespace orbweave
