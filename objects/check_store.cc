// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/check_store.h"

#include <algorithm>
#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "objects/granted_object.h"

namespace orbweave {
namespace {

constexpr int kGrant_s = 60;
/// Less most servers take as the last part alone.
constexpr size_t kUsualLeastPart = size_t{5} << 20;

absl::Status Expect(bool holds, const std::string& otherwise) {
  return holds ? absl::OkStatus() : absl::InternalError(otherwise);
}

/// OK when the store answered, and refused.
absl::Status ExpectRefusal(const absl::Status& status, const std::string& otherwise) {
  if (status.ok()) return absl::InternalError(otherwise);
  return absl::IsUnavailable(status) ? status : absl::OkStatus();
}

class StoreTrial {
 public:
  StoreTrial(S3Store& store, S3Store& long_ago, HttpClient& http)
      : store_(store), long_ago_(long_ago), http_(http) {}

  std::vector<StoreCheck> Run() {
    Row("put an object", store_.Put(key_, digest_, bytes_));
    Row("put it again", store_.Put(key_, digest_, bytes_));
    Row("get it", CheckBytes(std::nullopt, bytes_));
    Row("get a range of it", CheckBytes(ByteRange{3, 9}, bytes_.substr(3, 7)));
    Row("its size", CheckSize());
    Row("list it", CheckListed(true));
    Row("a key that is missing is said to be", CheckMissing());
    Row("put by a grant, without keys", PutGranted(granted_key_, bytes_));
    Row("get by a grant, without keys", GetGranted());
    Row("other bytes than were signed are refused", CheckWrongBytes());
    Row("a grant of an hour ago is refused", CheckExpired());
    Row("what is there is not written over (If-None-Match)", CheckCondition(), false);
    Row("put an object in parts (blobs above 5 GiB)", CheckParts(), false);
    Row("a part of other bytes is refused, its upload gone", CheckWrongPart(), false);
    Row("delete", Clean());
    return std::move(rows_);
  }

 private:
  void Row(std::string what, absl::Status result, bool is_needed = true) {
    rows_.push_back({std::move(what), std::move(result), is_needed});
  }

  absl::StatusOr<std::string> Read(const std::string& key, const std::optional<ByteRange>& range) {
    std::string read;
    ORBWEAVE_RETURN_IF_ERROR(store_.Get(key, range, [&read](std::string_view piece) {
      read += piece;
      return absl::OkStatus();
    }));
    return read;
  }

  absl::Status CheckBytes(const std::optional<ByteRange>& range, const std::string& expected) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string read, Read(key_, range));
    return Expect(read == expected, absl::StrCat("other bytes: ", read.size(), " of them"));
  }

  absl::Status CheckSize() {
    ORBWEAVE_ASSIGN_OR_RETURN(const ObjectInfo info, store_.Head(key_));
    return Expect(info.size_bytes == bytes_.size(), absl::StrCat(info.size_bytes, " bytes"));
  }

  absl::Status CheckListed(bool is_there) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<ObjectInfo> listed, store_.List());
    const bool is_listed = std::ranges::any_of(
        listed, [this](const ObjectInfo& object) { return object.key == key_; });
    return Expect(is_listed == is_there, is_there ? "it is not listed" : "it is still listed");
  }

  absl::Status CheckMissing() {
    const absl::Status found = Read(key_ + ".missing", std::nullopt).status();
    if (absl::IsNotFound(found)) return absl::OkStatus();
    if (absl::IsPermissionDenied(found))
      return Annotate(found,
                      "without the right to list (s3:ListBucket) none is said to be missing");
    return found.ok() ? absl::InternalError("it is found") : found;
  }

  absl::Status PutGranted(const std::string& key, std::string_view bytes) {
    const ObjectGrant grant = store_.GrantPut(key, digest_, bytes.size(), kGrant_s);
    return WriteGranted(http_, grant, bytes.size(), key, PiecesOf(bytes));
  }

  absl::Status GetGranted() {
    const ObjectGrant grant = store_.GrantGet(granted_key_, kGrant_s);
    const auto answer = http_.Do({.url = grant.url, .headers = grant.headers});
    ORBWEAVE_RETURN_IF_ERROR(answer.status());
    return Expect(answer->IsSuccess() && answer->body == bytes_,
                  absl::StrCat("the store answers ", answer->status));
  }

  absl::Status CheckWrongBytes() {
    std::string wrong = bytes_;
    wrong[0] ^= 1;
    return ExpectRefusal(PutGranted(key_ + ".wrong", wrong), "they are stored");
  }

  absl::Status CheckExpired() {
    const ObjectGrant grant = long_ago_.GrantGet(granted_key_, kGrant_s);
    ORBWEAVE_ASSIGN_OR_RETURN(const HttpAnswer answer,
                              http_.Do({.url = grant.url, .headers = grant.headers}));
    return Expect(answer.status == 403, absl::StrCat("the store answers ", answer.status));
  }

  absl::Status CheckCondition() {
    const std::string other = "other bytes";
    const ObjectGrant grant = store_.GrantPut(key_, DigestOf(other), other.size(), kGrant_s);
    ORBWEAVE_RETURN_IF_ERROR(WriteGranted(http_, grant, other.size(), key_, PiecesOf(other)));
    return CheckBytes(std::nullopt, bytes_);
  }

  absl::StatusOr<std::string> PutPart(const std::string& upload,
                                      uint32_t number,
                                      const Digest& digest,
                                      std::string_view bytes) {
    const ObjectPart part{
        .upload = upload, .number = number, .digest = digest, .size_bytes = bytes.size()};
    return WriteGrantedPart(http_, store_.GrantPart(parts_key_, part, kGrant_s), bytes, parts_key_);
  }

  absl::Status CheckParts() {
    const std::vector<std::string> parts = {std::string(kUsualLeastPart, 'p'), bytes_};
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string upload, store_.BeginUpload(parts_key_));
    std::vector<std::string> etags;
    for (const std::string& part : parts) {
      const auto number = static_cast<uint32_t>(etags.size() + 1);
      ORBWEAVE_ASSIGN_OR_RETURN(etags.emplace_back(),
                                PutPart(upload, number, DigestOf(part), part));
    }
    ORBWEAVE_RETURN_IF_ERROR(store_.FinishUpload(parts_key_, upload, etags));
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string read, Read(parts_key_, std::nullopt));
    return Expect(read == parts[0] + parts[1], absl::StrCat("other bytes: ", read.size()));
  }

  absl::Status CheckWrongPart() {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string upload, store_.BeginUpload(parts_key_));
    const absl::Status refused =
        ExpectRefusal(PutPart(upload, 1, digest_, "other bytes").status(), "it is stored");
    ORBWEAVE_RETURN_IF_ERROR(store_.AbortUpload(parts_key_, upload));
    ORBWEAVE_RETURN_IF_ERROR(refused);
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<UploadInfo> left, store_.ListUploads());
    return Expect(std::ranges::find(left, upload, &UploadInfo::upload) == left.end(),
                  "it is still listed");
  }

  absl::Status Clean() {
    for (const std::string& key : {key_, granted_key_, key_ + ".wrong", parts_key_})
      ORBWEAVE_RETURN_IF_ERROR(store_.Delete(key));
    return CheckListed(false);
  }

  S3Store& store_;
  S3Store& long_ago_;
  HttpClient& http_;
  const std::string key_ = absl::StrCat("check/", std::random_device{}());
  const std::string granted_key_ = key_ + ".granted";
  const std::string parts_key_ = key_ + ".parts";
  const std::string bytes_ = absl::StrCat("orbweave store check ", key_, std::string(100'000, '.'));
  const Digest digest_ = DigestOf(bytes_);
  std::vector<StoreCheck> rows_;
};

}  // namespace

std::vector<StoreCheck> CheckStore(
    const std::function<absl::StatusOr<std::unique_ptr<S3Store>>(UnixClock clock)>& make_store) {
  const auto store = make_store(UnixNow);
  const auto long_ago = make_store([] { return UnixNow() - 3600; });
  const auto http = HttpClient::Make();
  if (!store.ok()) return {{"open it", store.status()}};
  if (!long_ago.ok()) return {{"open it", long_ago.status()}};
  if (!http.ok()) return {{"open it", http.status()}};
  return StoreTrial(**store, **long_ago, **http).Run();
}

}  // namespace orbweave
