// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/grpc_granted_blobs.h"

#include <chrono>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/sleep.h"
#include "objects/granted_object.h"
#include "proto/codec/grants_codec.h"
#include "worker/grpc_blob_transfer.h"
#include "worker/grpc_status.h"

namespace orbweave {
namespace {

using Where = BlobGrant::Where;

std::string NameOf(const Digest& digest) { return absl::StrCat("blob ", digest.ToShortHex()); }

/// What a machine meets that others may not: libcurl is missing, the store's certificate is not
/// trusted, a proxy refuses. So the task is tried elsewhere.
absl::Status OfThisMachine(const absl::Status& status) {
  if (status.ok() || absl::IsUnavailable(status) || absl::IsNotFound(status) ||
      absl::IsResourceExhausted(status)) {
    return status;
  }
  return absl::InternalError(
      absl::StrCat("the object store cannot be used from here: ", status.message()));
}

/// Nothing: there is no object store.
absl::StatusOr<std::optional<BlobGrant>> Ask(v1::Coordinator::Stub& stub,
                                             const WantedBlob& blob,
                                             GrantVerb verb) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(1));
  v1::GrantBlobsReply reply;
  ORBWEAVE_RETURN_IF_ERROR(FromWire(stub.GrantBlobs(&context, ToProto({{blob}, verb}), &reply)));
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<BlobGrant> grants, FromProto(reply));
  if (grants.empty()) return std::nullopt;
  return std::move(grants.front());
}

/// Makes an object of its parts, or calls it off where there are none.
absl::Status End(v1::Coordinator::Stub& stub, const UploadEnd& end) {
  grpc::ClientContext context;
  // A server puts thousands of parts together before it answers.
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(10));
  v1::Empty ignored;
  return FromWire(stub.FinishUpload(&context, ToProto(end), &ignored));
}

/// Stores one part by rights that are asked for anew each time it is tried; its tag.
absl::StatusOr<std::string> WritePart(v1::Coordinator::Stub& stub,
                                      HttpClient& http,
                                      const WantedBlob& part,
                                      const std::string& bytes) {
  for (int attempt = 1;; ++attempt) {
    const auto grant = Ask(stub, part, GrantVerb::kPutPart);
    ORBWEAVE_RETURN_IF_ERROR(grant.status());
    if (!*grant || (*grant)->where != Where::kObject)
      return absl::UnavailableError("the coordinator has no object store any more");
    absl::StatusOr<std::string> etag =
        WriteGrantedPart(http, (*grant)->object, bytes, NameOf(part.digest));
    if (absl::IsDataLoss(etag.status()))
      etag = absl::UnavailableError(absl::StrCat(NameOf(part.digest), " arrived damaged"));
    if (!absl::IsUnavailable(etag.status()) || attempt == kMostAttempts) return etag;
    SleepUnlessStopped(PauseBefore_s(attempt), {});
  }
}

/// The pieces of a blob as parts of so many bytes, one at a time; counts what has come.
class PartsOf {
 public:
  PartsOf(const NextPiece& next, uint64_t part_bytes) : next_(next), part_bytes_(part_bytes) {}

  /// The next part; empty: that was all. Errors of `next`.
  [[nodiscard]] absl::StatusOr<std::string> Next() {
    std::string part;
    while (part.size() < part_bytes_) {
      if (rest_.empty()) {
        ORBWEAVE_ASSIGN_OR_RETURN(rest_, next_());
        if (rest_.empty()) break;
        builder_.Add(rest_);
      }
      const std::string_view taken = rest_.substr(0, part_bytes_ - part.size());
      part += taken;
      rest_.remove_prefix(taken.size());
      size_bytes_ += taken.size();
    }
    return part;
  }
  [[nodiscard]] Digest Finish() { return builder_.Finish(); }
  [[nodiscard]] uint64_t size_bytes() const { return size_bytes_; }

 private:
  const NextPiece& next_;
  const uint64_t part_bytes_;
  std::string_view rest_;
  uint64_t size_bytes_ = 0;
  DigestBuilder builder_;
};

/// The coordinator looks at the blob itself, and removes it when it is damaged.
absl::Status Complain(v1::Coordinator::Stub& stub, const Digest& digest) {
  const absl::Status read =
      ReceiveBlob(stub, digest, [](std::string_view) { return absl::OkStatus(); });
  if (!read.ok()) return read;
  return absl::UnavailableError(absl::StrCat(NameOf(digest), " arrived damaged"));
}

}  // namespace

absl::StatusOr<HttpClient*> GrantedBlobs::Http() {
  const std::lock_guard lock(mutex_);
  if (!http_) {
    ORBWEAVE_ASSIGN_OR_RETURN(http_, HttpClient::Make());
  }
  return http_.get();
}

std::optional<absl::Status> GrantedBlobs::Read(v1::Coordinator::Stub& stub,
                                               const Digest& digest,
                                               const TakePiece& take) {
  if (!has_store_) return std::nullopt;
  const auto grant = Ask(stub, {.digest = digest}, GrantVerb::kGet);
  if (!grant.ok()) return grant.status();
  if (!*grant) has_store_ = false;
  if (!*grant || (*grant)->where != Where::kObject) return std::nullopt;
  const absl::StatusOr<HttpClient*> http = Http();
  if (!http.ok()) return OfThisMachine(http.status());
  DigestBuilder builder;
  absl::Status taken;
  const auto take_and_count = [&](std::string_view piece) {
    builder.Add(piece);
    taken = take(piece);
    return taken;
  };
  const absl::Status read =
      ReadGranted(**http, (*grant)->object, std::nullopt, NameOf(digest), take_and_count);
  if (!taken.ok()) return taken;
  if (absl::IsNotFound(read)) return std::nullopt;  // the coordinator is to know of it
  if (!read.ok()) return OfThisMachine(read);
  if (builder.Finish() == digest) return absl::OkStatus();
  return Complain(stub, digest);
}

absl::Status GrantedBlobs::WriteParts(v1::Coordinator::Stub& stub,
                                      const Digest& digest,
                                      uint64_t size_bytes,
                                      const BlobGrant& grant,
                                      const NextPiece& next) {
  UploadEnd end{.digest = digest, .upload = grant.upload};
  const auto write = [&]() -> absl::Status {
    ORBWEAVE_ASSIGN_OR_RETURN(HttpClient* const http, Http());
    PartsOf parts(next, grant.part_bytes);
    while (true) {
      ORBWEAVE_ASSIGN_OR_RETURN(const std::string part, parts.Next());
      if (part.empty()) break;
      const auto number = static_cast<uint32_t>(end.etags.size() + 1);
      const WantedBlob wanted{digest,
                              size_bytes,
                              {.upload = grant.upload,
                               .number = number,
                               .digest = DigestOf(part),
                               .size_bytes = part.size()}};
      ORBWEAVE_ASSIGN_OR_RETURN(end.etags.emplace_back(), WritePart(stub, *http, wanted, part));
    }
    if (parts.size_bytes() == size_bytes && parts.Finish() == digest) return absl::OkStatus();
    return absl::DataLossError(absl::StrCat(NameOf(digest), ": the bytes are not what was named"));
  };
  const absl::Status written = write();
  if (written.ok()) return End(stub, end);
  end.etags.clear();
  End(stub, end).IgnoreError();  // the coordinator calls it off in time
  return written;
}

std::optional<absl::Status> GrantedBlobs::Write(v1::Coordinator::Stub& stub,
                                                const Digest& digest,
                                                uint64_t size_bytes,
                                                const NextPiece& next) {
  if (!has_store_ || size_bytes < kLeastObjectBytes) return std::nullopt;
  const auto grant = Ask(stub, {digest, size_bytes}, GrantVerb::kPut);
  if (!grant.ok()) return grant.status();
  if (!*grant) has_store_ = false;
  if (!*grant || (*grant)->where == Where::kCoordinator) return std::nullopt;
  if ((*grant)->where == Where::kNowhere) return absl::OkStatus();
  const absl::StatusOr<HttpClient*> http = Http();
  if (!http.ok()) return OfThisMachine(http.status());
  absl::Status given;
  const auto next_and_note = [&]() -> absl::StatusOr<std::string_view> {
    absl::StatusOr<std::string_view> piece = next();
    given = piece.status();
    return piece;
  };
  if ((*grant)->where == Where::kParts) {
    const absl::Status written = WriteParts(stub, digest, size_bytes, **grant, next_and_note);
    if (!given.ok() || absl::IsDataLoss(written)) return given.ok() ? written : given;
    return OfThisMachine(written);
  }
  const absl::Status written =
      WriteGranted(**http, (*grant)->object, size_bytes, NameOf(digest), next_and_note);
  if (!given.ok()) return given;
  if (absl::IsDataLoss(written))
    return absl::UnavailableError(absl::StrCat(NameOf(digest), " arrived damaged"));
  return OfThisMachine(written);
}

}  // namespace orbweave
