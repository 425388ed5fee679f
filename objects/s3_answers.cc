// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_answers.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "objects/s3_address.h"

namespace orbweave {
namespace {

/// Clocks that differ by less are not to blame.
constexpr int64_t kSkew_s = 120;

/// The text between <NAME> and </NAME>, the first time from `begin` on; nothing: there is none.
/// `begin` becomes its end.
std::optional<std::string_view> NextElement(std::string_view xml,
                                            const std::string& name,
                                            size_t& begin) {
  const std::string opens = absl::StrCat("<", name, ">");
  const std::string closes = absl::StrCat("</", name, ">");
  const size_t from = xml.find(opens, begin);
  if (from == std::string_view::npos) return std::nullopt;
  const size_t to = xml.find(closes, from + opens.size());
  if (to == std::string_view::npos) return std::nullopt;
  begin = to + closes.size();
  return xml.substr(from + opens.size(), to - from - opens.size());
}

/// The character of the entity that `text` begins with, and the entity's length; nothing: it begins
/// with none that a store writes. Go's servers write quotes as &#34;.
std::optional<std::pair<char, size_t>> EntityOf(std::string_view text) {
  constexpr std::pair<std::string_view, char> kNamed[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  for (const auto& [name, c] : kNamed) {
    if (text.starts_with(name)) return std::pair(c, name.size());
  }
  constexpr size_t kLongest = 6;  // &#x7E;
  const size_t end = text.substr(0, kLongest).find(';');
  if (!text.starts_with("&#") || end == std::string_view::npos) return std::nullopt;
  const std::string digits(text.substr(2, end - 2));
  uint32_t code = 0;
  const bool is_number = digits.starts_with('x') ? absl::SimpleHexAtoi(digits.substr(1), &code)
                                                 : absl::SimpleAtoi(digits, &code);
  if (!is_number || code == 0 || code > 127) return std::nullopt;
  return std::pair(static_cast<char>(code), end + 1);
}

std::string TextOf(std::string_view xml, const std::string& name) {
  size_t begin = 0;
  std::string_view rest = NextElement(xml, name, begin).value_or(std::string_view());
  std::string text;
  while (!rest.empty()) {
    const auto [c, length] = EntityOf(rest).value_or(std::pair(rest.front(), size_t{1}));
    text += c;
    rest.remove_prefix(length);
  }
  return text;
}

/// How far our clock is from the server's, in words, where it is to blame.
std::string BlameClock(const HttpAnswer& answer, int64_t now_unix_s) {
  const absl::StatusOr<int64_t> theirs = ParseHttpTime(answer.Header("date"));
  if (!theirs.ok() || std::abs(now_unix_s - *theirs) < kSkew_s) return {};
  return absl::StrCat("; the clock of this machine is ",
                      std::abs(now_unix_s - *theirs),
                      " s ",
                      now_unix_s > *theirs ? "ahead of" : "behind",
                      " the store's: set it right");
}

bool IsPassing(int status, const std::string& code) {
  return status == 409 || status == 429 || status >= 500 || code == "RequestTimeout" ||
         code == "RequestTimeTooSkewed" || code == "RequestExpired" || code == "SlowDown";
}

absl::StatusCode CodeOf(int status, const std::string& code, const std::string& message) {
  using Code = absl::StatusCode;
  if (code == "NoSuchBucket") return Code::kFailedPrecondition;
  if (status == 404) return Code::kNotFound;
  if (status == 412) return Code::kAlreadyExists;
  if (status == 416) return Code::kOutOfRange;
  if (status == 501 || code == "NotImplemented") return Code::kUnimplemented;
  if (status >= 300 && status < 400) return Code::kFailedPrecondition;
  if (IsPassing(status, code)) return Code::kUnavailable;
  if (message.find("expired") != std::string::npos) return Code::kUnavailable;
  if (code == "BadDigest" || code == "XAmzContentSHA256Mismatch" ||
      code == "XAmzContentChecksumMismatch" || code == "InvalidDigest") {
    return Code::kDataLoss;
  }
  return Code::kPermissionDenied;
}

}  // namespace

absl::Status StatusOfS3(const HttpAnswer& answer, const std::string& what, int64_t now_unix_s) {
  if (answer.IsSuccess()) return absl::OkStatus();
  const std::string code = TextOf(answer.body, "Code");
  const std::string message = TextOf(answer.body, "Message");
  const std::string region = answer.Header("x-amz-bucket-region");
  const absl::StatusCode kind = CodeOf(answer.status, code, message);
  std::string clock = answer.status == 403 ? BlameClock(answer, now_unix_s) : std::string();
  // A clock that is wrong is set right, whatever the server says of what follows from it.
  const bool is_skewed = !clock.empty();
  return {is_skewed ? absl::StatusCode::kUnavailable : kind,
          absl::StrCat(what,
                       ": the store answers ",
                       answer.status,
                       code.empty() ? "" : " ",
                       code,
                       message.empty() ? "" : ", ",
                       message,
                       kind == absl::StatusCode::kFailedPrecondition && !region.empty()
                           ? absl::StrCat("; the bucket is in region ", region)
                           : "",
                       clock)};
}

absl::StatusOr<ObjectPage> ParseObjectPage(std::string_view xml) {
  if (xml.find("<ListBucketResult") == std::string_view::npos)
    return absl::DataLossError("the store answers with no list of objects");
  const bool is_encoded = TextOf(xml, "EncodingType") == "url";
  ObjectPage page;
  size_t begin = 0;
  while (const auto element = NextElement(xml, "Contents", begin)) {
    ObjectInfo& object = page.objects.emplace_back();
    object.key = TextOf(*element, "Key");
    if (is_encoded) {
      ORBWEAVE_ASSIGN_OR_RETURN(object.key, UriDecode(object.key));
    }
    const absl::StatusOr<int64_t> modified = ParseHttpTime(TextOf(*element, "LastModified"));
    if (!modified.ok() || !absl::SimpleAtoi(TextOf(*element, "Size"), &object.size_bytes))
      return absl::DataLossError("the store lists an object without its size or time");
    object.modified_unix_s = *modified;
    object.etag = TextOf(*element, "ETag");
    // It is sent back in a header.
    if (!std::ranges::all_of(object.etag, [](char c) { return c > ' ' && c <= '~'; }))
      return absl::DataLossError("the store lists an object with an ETag that is none");
  }
  if (TextOf(xml, "IsTruncated") != "true") return page;
  page.next = TextOf(xml, "NextContinuationToken");
  if (page.next.empty()) return absl::DataLossError("the store lists half and not how to go on");
  return page;
}

absl::StatusOr<std::string> ParseUpload(std::string_view xml) {
  std::string upload = TextOf(xml, "UploadId");
  if (upload.empty()) return absl::DataLossError("the store names no upload in parts");
  return upload;
}

absl::StatusOr<std::vector<UploadInfo>> ParseUploads(std::string_view xml) {
  if (xml.find("<ListMultipartUploadsResult") == std::string_view::npos)
    return absl::DataLossError("the store answers with no list of uploads");
  const bool is_encoded = TextOf(xml, "EncodingType") == "url";
  std::vector<UploadInfo> uploads;
  size_t begin = 0;
  while (const auto element = NextElement(xml, "Upload", begin)) {
    UploadInfo& upload = uploads.emplace_back();
    upload.key = TextOf(*element, "Key");
    if (is_encoded) {
      ORBWEAVE_ASSIGN_OR_RETURN(upload.key, UriDecode(upload.key));
    }
    upload.upload = TextOf(*element, "UploadId");
    const absl::StatusOr<int64_t> begun = ParseHttpTime(TextOf(*element, "Initiated"));
    if (!begun.ok() || upload.upload.empty())
      return absl::DataLossError("the store lists an upload without its name or time");
    upload.begun_unix_s = *begun;
  }
  return uploads;
}

std::string PartsXml(const std::vector<std::string>& etags) {
  std::string xml = "<CompleteMultipartUpload>";
  for (size_t i = 0; i < etags.size(); ++i) {
    absl::StrAppend(&xml,
                    "<Part><PartNumber>",
                    i + 1,
                    "</PartNumber><ETag>",
                    absl::StrReplaceAll(etags[i], {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}}),
                    "</ETag></Part>");
  }
  return xml + "</CompleteMultipartUpload>";
}

absl::Status StatusOfFinish(const HttpAnswer& answer, const std::string& what) {
  if (answer.body.find("<Error>") == std::string::npos) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat(what,
                                             ": the store could not put the parts together: ",
                                             TextOf(answer.body, "Code"),
                                             ", ",
                                             TextOf(answer.body, "Message")));
}

absl::StatusOr<int64_t> ParseHttpTime(const std::string& text) {
  for (const char* form : {"%a, %d %b %Y %H:%M:%S GMT", "%Y-%m-%dT%H:%M:%S"}) {
    std::tm utc{};
    const char* const rest = ::strptime(text.c_str(), form, &utc);
    if (rest == nullptr || (*rest != '\0' && *rest != '.' && *rest != 'Z')) continue;
    return static_cast<int64_t>(::timegm(&utc));
  }
  return absl::InvalidArgumentError("no time of HTTP");
}

}  // namespace orbweave
