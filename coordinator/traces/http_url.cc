// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/http_url.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

constexpr std::string_view kScheme = "http://";

absl::Status NotOne(std::string_view text, const char* why) {
  return absl::InvalidArgumentError(absl::StrCat(
      "'", absl::CHexEscape(std::string(text.substr(0, 200))), "' is not taken as URL: ", why));
}

/// What a request line and a Host header can hold.
bool IsPlain(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c > ' ' && c < 0x7f; });
}

bool IsHost(std::string_view host) {
  return !host.empty() && std::ranges::all_of(host, [](char c) {
    return absl::ascii_isalnum(c) || c == '.' || c == '-' || c == '_' || c == ':';
  });
}

bool IsPort(std::string_view port) {
  uint32_t number = 0;
  return port.size() <= 5 && std::ranges::all_of(port, absl::ascii_isdigit) &&
         absl::SimpleAtoi(std::string(port), &number) && number >= 1 && number <= 65535;
}

}  // namespace

std::string HttpUrl::Authority() const {
  const bool is_bare_address = host.find(':') != std::string::npos;
  return is_bare_address ? absl::StrCat("[", host, "]:", port) : absl::StrCat(host, ":", port);
}

std::string HttpUrl::ToText() const { return absl::StrCat("http://", Authority(), target); }

absl::StatusOr<HttpUrl> ParseHttpUrl(std::string_view text) {
  if (text.starts_with("https://")) {
    return NotOne(text,
                  "https is not spoken here; name a collector on this machine or in its network by "
                  "http, which passes on by https what it gets");
  }
  if (!text.starts_with(kScheme)) return NotOne(text, "it has the form http://HOST:PORT");
  if (!IsPlain(text)) return NotOne(text, "it has spaces or other bytes that no URL has");
  const std::string_view rest = text.substr(kScheme.size());
  const size_t slash = std::min(rest.find_first_of("/?#"), rest.size());
  const std::string_view authority = rest.substr(0, slash);
  if (rest.find('#') != std::string_view::npos) return NotOne(text, "no fragment is sent");
  if (authority.find('@') != std::string_view::npos)
    return NotOne("http://...@...", "a user or password would be sent in the clear");
  const bool is_bracketed = authority.starts_with('[');
  const size_t end = is_bracketed ? authority.find(']') : authority.find(':');
  HttpUrl url{.port = "80", .target = std::string(rest.substr(slash))};
  if (!url.target.starts_with('/')) url.target.insert(0, "/");
  url.host = std::string(authority.substr(is_bracketed ? 1 : 0, end - (is_bracketed ? 1 : 0)));
  std::string_view behind;
  if (end != std::string_view::npos) behind = authority.substr(end + (is_bracketed ? 1 : 0));
  if (is_bracketed && end == std::string_view::npos) return NotOne(text, "a bracket is missing");
  if (!is_bracketed && url.host.find(':') != std::string::npos)
    return NotOne(text, "an IPv6 address stands in brackets");
  if (!IsHost(url.host)) return NotOne(text, "it names no host");
  if (behind.empty()) return url;
  if (!behind.starts_with(':') || !IsPort(behind.substr(1)))
    return NotOne(text, "its port is no number of 1 to 65535");
  url.port = std::string(behind.substr(1));
  return url;
}

}  // namespace orbweave
