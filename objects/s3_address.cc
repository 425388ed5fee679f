// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_address.h"

#include <algorithm>
#include <map>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace orbweave {
namespace {

constexpr char kScheme[] = "s3://";
constexpr char kForm[] =
    "s3://BUCKET[/PREFIX][?endpoint=https://HOST[:PORT]][&region=REGION][&style=path|host]";

bool IsUnreserved(char c) {
  return absl::ascii_isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.' || c == '_' ||
         c == '~';
}

absl::Status Misspelt(const std::string& text, absl::string_view why) {
  return absl::InvalidArgumentError(absl::StrCat("'", text, "' is not ", kForm, ": ", why));
}

bool IsBucketName(std::string_view name) {
  return name.size() >= 3 && name.size() <= 63 && std::ranges::all_of(name, [](char c) {
           return absl::ascii_islower(static_cast<unsigned char>(c)) ||
                  absl::ascii_isdigit(static_cast<unsigned char>(c)) || c == '-' || c == '.';
         });
}

bool IsRegion(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return absl::ascii_isalnum(static_cast<unsigned char>(c)) || c == '-';
  });
}

bool IsHost(std::string_view host) {
  return !host.empty() && std::ranges::all_of(host, [](char c) {
    return IsUnreserved(c) || c == ':' || c == '[' || c == ']';
  });
}

bool IsLoopback(std::string_view host) {
  if (host.starts_with("[::1]")) return true;
  const std::string_view name = host.substr(0, host.find(':'));
  return name == "localhost" || name.starts_with("127.");
}

std::string WithoutSlashes(std::string_view text) {
  while (text.starts_with('/')) text.remove_prefix(1);
  while (text.ends_with('/')) text.remove_suffix(1);
  return std::string(text);
}

/// The parts of a query by name, decoded.
absl::StatusOr<std::map<std::string, std::string>> ParseQuery(const std::string& query) {
  std::map<std::string, std::string> parts;
  const std::vector<std::string> words = absl::StrSplit(query, '&', absl::SkipEmpty());
  for (const std::string& part : words) {
    const size_t equals = std::min(part.find('='), part.size());
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string value,
                              UriDecode(part.substr(std::min(equals + 1, part.size()))));
    parts[part.substr(0, equals)] = value;
  }
  return parts;
}

absl::Status TakeEndpoint(std::string_view endpoint, bool is_plain, S3Address& address) {
  const size_t colon = endpoint.find("://");
  address.scheme = std::string(endpoint.substr(0, colon));
  if (address.scheme != "http" && address.scheme != "https")
    return absl::InvalidArgumentError("the endpoint is no http:// or https:// URL");
  endpoint.remove_prefix(colon + 3);
  if (endpoint.ends_with('/')) endpoint.remove_suffix(1);
  if (!IsHost(endpoint)) return absl::InvalidArgumentError("the endpoint is more than a host");
  address.host = std::string(endpoint);
  address.bucket_in_path = true;
  if (address.scheme == "https" || is_plain || IsLoopback(endpoint)) return absl::OkStatus();
  return absl::InvalidArgumentError(
      "over http whoever sees the network reads all; plain=yes says that this may be");
}

absl::Status TakeOption(const std::string& name, const std::string& value, S3Address& address) {
  if (name == "region" && IsRegion(value)) {
    address.region = value;
    return absl::OkStatus();
  }
  if (name == "style" && (value == "path" || value == "host")) {
    address.bucket_in_path = value == "path";
    return absl::OkStatus();
  }
  if (name == "plain" && value == "yes") return absl::OkStatus();
  if (name == "endpoint") return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(name, "=", value, " is unknown"));
}

absl::Status TakeQuery(const std::string& query, S3Address& address) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto parts, ParseQuery(query));
  if (const auto endpoint = parts.find("endpoint"); endpoint != parts.end())
    ORBWEAVE_RETURN_IF_ERROR(TakeEndpoint(endpoint->second, parts.contains("plain"), address));
  for (const auto& [name, value] : parts)
    ORBWEAVE_RETURN_IF_ERROR(TakeOption(name, value, address));
  return absl::OkStatus();
}

}  // namespace

std::string UriEncode(std::string_view text, bool keeps_slash) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    if (IsUnreserved(c) || (keeps_slash && c == '/')) {
      encoded += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      encoded += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return encoded;
}

absl::StatusOr<std::string> UriDecode(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    uint32_t byte = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const bool is_hex = digits.size() == 2 && std::ranges::all_of(digits, [](char c) {
                          return absl::ascii_isxdigit(static_cast<unsigned char>(c));
                        });
    if (!is_hex || !absl::SimpleHexAtoi(std::string(digits), &byte))
      return absl::InvalidArgumentError("a '%' without two hexadecimal digits");
    decoded += static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

std::string S3Address::HostOfBucket() const {
  return bucket_in_path ? host : absl::StrCat(bucket, ".", host);
}

std::string S3Address::KeyOf(const std::string& key) const {
  return prefix.empty() ? key : absl::StrCat(prefix, "/", key);
}

std::string S3Address::PathOf(const std::string& key) const {
  const std::string bucket_path = bucket_in_path ? absl::StrCat("/", bucket) : std::string();
  if (key.empty()) return bucket_path.empty() ? "/" : bucket_path;
  return absl::StrCat(bucket_path, "/", UriEncode(KeyOf(key), true));
}

std::string S3Address::ToText() const {
  return absl::StrCat(kScheme, bucket, prefix.empty() ? "" : "/", prefix);
}

bool IsS3Address(std::string_view text) { return text.starts_with(kScheme); }

absl::StatusOr<S3Address> ParseS3Address(const std::string& text) {
  if (!IsS3Address(text)) return Misspelt(text, "it begins otherwise");
  const std::string rest = text.substr(std::string_view(kScheme).size());
  const size_t question = std::min(rest.find('?'), rest.size());
  const std::string place = rest.substr(0, question);
  const size_t slash = std::min(place.find('/'), place.size());
  S3Address address{.bucket = place.substr(0, slash),
                    .prefix = WithoutSlashes(place.substr(slash))};
  if (!IsBucketName(address.bucket)) return Misspelt(text, "no name of a bucket");
  const absl::Status taken = TakeQuery(rest.substr(std::min(question + 1, rest.size())), address);
  if (!taken.ok()) return Misspelt(text, taken.message());
  return address;
}

}  // namespace orbweave
