// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_store.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/base/sleep.h"
#include "objects/granted_object.h"
#include "objects/s3_answers.h"

namespace orbweave {
namespace {

/// The rights of this process to its own requests.
constexpr int kOwn_s = 600;
/// Signed, and said by who sends the bytes.
constexpr char kLength[] = "content-length";

/// What `call()` answers, tried a few times while that is Unavailable.
template <typename Call>
auto TryAgain(Call&& call) -> decltype(call()) {
  for (int attempt = 1;; ++attempt) {
    auto answer = call();
    const absl::Status status = internal::StatusOf(answer);
    if (!absl::IsUnavailable(status) || attempt == kMostAttempts) return answer;
    SleepUnlessStopped(PauseBefore_s(attempt), {});
  }
}

}  // namespace

absl::StatusOr<std::unique_ptr<S3Store>> S3Store::Make(S3Address address,
                                                       S3Keys keys,
                                                       const HttpPatience& patience,
                                                       UnixClock clock) {
  constexpr char kUsualRegion[] = "us-east-1";
  if (!address.region.empty()) keys.region = address.region;
  if (keys.region.empty()) keys.region = kUsualRegion;
  if (address.host.empty()) address.host = absl::StrCat("s3.", keys.region, ".amazonaws.com");
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<HttpClient> http, HttpClient::Make(patience));
  return std::unique_ptr<S3Store>(
      new S3Store(std::move(address), std::move(keys), std::move(clock), std::move(http)));
}

std::string S3Store::NameOf(const std::string& key) const {
  return key.empty() ? address_.ToText() : absl::StrCat(address_.ToText(), "/", key);
}

ObjectGrant S3Store::Grant(S3Request request, int valid_s) const {
  request.host = address_.HostOfBucket();
  ObjectGrant grant;
  for (const auto& [name, value] : request.headers) {
    if (name != kLength) grant.headers.push_back(absl::StrCat(name, ": ", value));
  }
  const std::string server = absl::StrCat(address_.scheme, "://", request.host);
  grant.url = server + Presign(std::move(request), keys_, clock_(), valid_s);
  return grant;
}

ObjectGrant S3Store::GrantGet(const std::string& key, int valid_s) {
  return Grant({.path = address_.PathOf(key)}, valid_s);
}

ObjectGrant S3Store::GrantPut(const std::string& key,
                              const Digest& digest,
                              uint64_t size_bytes,
                              int valid_s) {
  S3Request request{
      .method = "PUT",
      .path = address_.PathOf(key),
      .headers = {{kLength, absl::StrCat(size_bytes)}, {"x-amz-content-sha256", digest.ToHex()}}};
  if (knows_conditions_) request.headers["if-none-match"] = "*";
  return Grant(std::move(request), valid_s);
}

absl::StatusOr<HttpAnswer> S3Store::Ask(const S3Request& request,
                                        const std::string& what,
                                        const std::string& body) {
  return TryAgain([&]() -> absl::StatusOr<HttpAnswer> {
    const ObjectGrant grant = Grant(request, kOwn_s);
    HttpCall call{.method = request.method, .url = grant.url, .headers = grant.headers};
    if (request.method == "POST") {
      call.body_bytes = body.size();
      call.next = PiecesOf(body);
    }
    absl::StatusOr<HttpAnswer> answer = http_->Do(call);
    if (answer.ok()) ORBWEAVE_RETURN_IF_ERROR(StatusOfS3(*answer, what, clock_()));
    return answer;
  });
}

absl::StatusOr<ObjectInfo> S3Store::Head(const std::string& key) {
  ORBWEAVE_ASSIGN_OR_RETURN(const HttpAnswer answer,
                            Ask({.method = "HEAD", .path = address_.PathOf(key)}, NameOf(key)));
  ObjectInfo info;
  const absl::StatusOr<int64_t> modified = ParseHttpTime(answer.Header("last-modified"));
  if (!modified.ok() || !absl::SimpleAtoi(answer.Header("content-length"), &info.size_bytes))
    return absl::DataLossError(absl::StrCat(NameOf(key), ": the store tells no size or time"));
  info.modified_unix_s = *modified;
  return info;
}

absl::Status S3Store::Get(const std::string& key,
                          const std::optional<ByteRange>& range,
                          const TakePiece& take) {
  return ReadGranted(*http_, GrantGet(key, kOwn_s), range, NameOf(key), take);
}

absl::Status S3Store::Put(const std::string& key, const Digest& digest, std::string_view bytes) {
  const auto put = [&] {
    return WriteGranted(*http_,
                        GrantPut(key, digest, bytes.size(), kOwn_s),
                        bytes.size(),
                        NameOf(key),
                        PiecesOf(bytes));
  };
  const absl::Status status = TryAgain(put);
  if (!absl::IsUnimplemented(status) || !knows_conditions_.exchange(false)) return status;
  return TryAgain(put);
}

absl::Status S3Store::Delete(const std::string& key) {
  const absl::Status status =
      Ask({.method = "DELETE", .path = address_.PathOf(key)}, NameOf(key)).status();
  return absl::IsNotFound(status) ? absl::OkStatus() : status;
}

absl::Status S3Store::GetVersion(const std::string& key,
                                 const std::string& etag,
                                 const TakePiece& take) {
  ObjectGrant grant = GrantGet(key, kOwn_s);
  if (!etag.empty()) grant.headers.push_back(absl::StrCat("if-match: ", etag));
  const absl::Status read = ReadGranted(*http_, grant, std::nullopt, NameOf(key), take);
  if (!absl::IsAlreadyExists(read)) return read;  // which is what 412 means to who stores
  return absl::AbortedError(absl::StrCat(NameOf(key), " has changed"));
}

absl::Status S3Store::ListPages(const TakeObjects& take) {
  const std::string folder = address_.prefix.empty() ? "" : address_.prefix + "/";
  S3Request request{.path = address_.PathOf(""),
                    .query = {{"encoding-type", "url"}, {"list-type", "2"}, {"prefix", folder}}};
  do {
    ORBWEAVE_ASSIGN_OR_RETURN(const HttpAnswer answer, Ask(request, NameOf("")));
    ORBWEAVE_ASSIGN_OR_RETURN(ObjectPage page, ParseObjectPage(answer.body));
    std::erase_if(page.objects,
                  [&](const ObjectInfo& object) { return !object.key.starts_with(folder); });
    for (ObjectInfo& object : page.objects) object.key.erase(0, folder.size());
    ORBWEAVE_RETURN_IF_ERROR(take(std::move(page.objects)));
    request.query["continuation-token"] = page.next;
  } while (!request.query["continuation-token"].empty());
  return absl::OkStatus();
}

absl::StatusOr<std::vector<ObjectInfo>> S3Store::List() {
  std::vector<ObjectInfo> objects;
  ORBWEAVE_RETURN_IF_ERROR(ListPages([&objects](std::vector<ObjectInfo> page) {
    std::ranges::move(page, std::back_inserter(objects));
    return absl::OkStatus();
  }));
  return objects;
}

absl::StatusOr<std::string> S3Store::BeginUpload(const std::string& key) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const HttpAnswer answer,
      Ask({.method = "POST", .path = address_.PathOf(key), .query = {{"uploads", ""}}},
          NameOf(key)));
  return ParseUpload(answer.body);
}

ObjectGrant S3Store::GrantPart(const std::string& key, const ObjectPart& part, int valid_s) {
  return Grant({.method = "PUT",
                .path = address_.PathOf(key),
                .query = {{"partNumber", absl::StrCat(part.number)}, {"uploadId", part.upload}},
                .headers = {{kLength, absl::StrCat(part.size_bytes)},
                            {"x-amz-content-sha256", part.digest.ToHex()}}},
               valid_s);
}

absl::Status S3Store::FinishUpload(const std::string& key,
                                   const std::string& upload,
                                   const std::vector<std::string>& etags) {
  const auto finish = [&](bool has_condition) -> absl::Status {
    S3Request request{
        .method = "POST", .path = address_.PathOf(key), .query = {{"uploadId", upload}}};
    if (has_condition) request.headers["if-none-match"] = "*";
    const absl::StatusOr<HttpAnswer> answer = Ask(request, NameOf(key), PartsXml(etags));
    ORBWEAVE_RETURN_IF_ERROR(answer.status());
    return StatusOfFinish(*answer, NameOf(key));
  };
  absl::Status status = finish(knows_conditions_);
  if (absl::IsUnimplemented(status) && knows_conditions_.exchange(false)) status = finish(false);
  if (absl::IsAlreadyExists(status)) return AbortUpload(key, upload);
  if (!absl::IsNotFound(status)) return status;
  // It was finished by an answer that did not arrive, or by who brings the same.
  return Head(key).ok() ? absl::OkStatus() : status;
}

absl::Status S3Store::AbortUpload(const std::string& key, const std::string& upload) {
  const absl::Status status =
      Ask({.method = "DELETE", .path = address_.PathOf(key), .query = {{"uploadId", upload}}},
          NameOf(key))
          .status();
  return absl::IsNotFound(status) ? absl::OkStatus() : status;
}

absl::StatusOr<std::vector<UploadInfo>> S3Store::ListUploads() {
  const std::string folder = address_.prefix.empty() ? "" : address_.prefix + "/";
  ORBWEAVE_ASSIGN_OR_RETURN(
      const HttpAnswer answer,
      Ask({.path = address_.PathOf(""),
           .query = {{"encoding-type", "url"}, {"prefix", folder}, {"uploads", ""}}},
          NameOf("")));
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<UploadInfo> uploads, ParseUploads(answer.body));
  std::erase_if(uploads, [&](const UploadInfo& upload) { return !upload.key.starts_with(folder); });
  for (UploadInfo& upload : uploads) upload.key.erase(0, folder.size());
  return uploads;
}

absl::StatusOr<std::unique_ptr<S3Store>> OpenS3Store(const std::string& address,
                                                     const std::string& keys_path) {
  ORBWEAVE_ASSIGN_OR_RETURN(S3Address parsed, ParseS3Address(address));
  ORBWEAVE_ASSIGN_OR_RETURN(S3Keys keys, FindS3Keys(keys_path));
  return S3Store::Make(std::move(parsed), std::move(keys));
}

}  // namespace orbweave
