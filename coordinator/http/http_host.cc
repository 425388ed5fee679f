// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/http/http_host.h"

#include <algorithm>
#include <string>

#include "absl/strings/ascii.h"

namespace orbweave {
namespace {

/// Without its port; empty: it is malformed.
std::string_view WithoutPort(std::string_view header) {
  const size_t bracket = header.starts_with('[') ? header.find(']') : 0;
  if (bracket == std::string_view::npos) return {};
  const size_t colon = header.find(':', bracket);
  if (colon == std::string_view::npos) return header;
  const std::string_view port = header.substr(colon + 1);
  return std::ranges::all_of(port, absl::ascii_isdigit) ? header.substr(0, colon)
                                                        : std::string_view();
}

}  // namespace

bool NamesThisHost(std::string_view host_header, std::string_view listened_host) {
  const std::string host = absl::AsciiStrToLower(std::string(WithoutPort(host_header)));
  if (host.empty()) return false;
  return host == "localhost" || host == "127.0.0.1" || host == "[::1]" ||
         host == absl::AsciiStrToLower(std::string(listened_host));
}

}  // namespace orbweave
