// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/listen_address.h"

#include <sys/un.h>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace orbweave {
namespace {

bool IsLoopback(const std::string& host) {
  if (host == "localhost" || host == "[::1]") return true;
  const std::vector<std::string> bytes = absl::StrSplit(host, '.');
  if (bytes.size() != 4 || bytes[0] != "127") return false;
  for (const std::string& byte : bytes) {
    int value = 0;
    if (!absl::SimpleAtoi(byte, &value) || value < 0 || value > 255) return false;
  }
  return true;
}

absl::Status CheckSocketPath(const std::string& path) {
  constexpr size_t kLongest = sizeof(sockaddr_un::sun_path) - 1;
  if (path.empty())
    return absl::InvalidArgumentError("'unix:' is followed by the path of the socket");
  if (path.size() > kLongest) {
    return absl::InvalidArgumentError(absl::StrCat(
        "the socket path ", path, " is longer than the ", kLongest, " bytes the system allows"));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status CheckListenAddress(const std::string& address, Wire wire) {
  const bool is_encrypted = wire == Wire::kEncrypted;
  if (absl::StartsWith(address, "unix:")) {
    if (!is_encrypted) return CheckSocketPath(address.substr(5));
    return absl::InvalidArgumentError("a unix socket is guarded by its folder: it has no TLS");
  }
  const size_t colon = address.rfind(':');
  int port = -1;
  if (colon == std::string::npos || !absl::SimpleAtoi(address.substr(colon + 1), &port) ||
      port < 0 || port > 65535) {
    return absl::InvalidArgumentError(
        absl::StrCat("'", address, "' is no address: give unix:/path or 127.0.0.1:port"));
  }
  if (is_encrypted || IsLoopback(address.substr(0, colon))) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      "refusing to listen on ",
      address,
      ": without TLS only a unix socket or a loopback address (127.0.0.1:port) is allowed; "
      "for other machines make keys (orbweave keys init) and give them with --tls"));
}

}  // namespace orbweave
