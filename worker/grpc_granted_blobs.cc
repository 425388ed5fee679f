// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/grpc_granted_blobs.h"

#include <chrono>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
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
  const absl::Status written =
      WriteGranted(**http, (*grant)->object, size_bytes, NameOf(digest), next_and_note);
  if (!given.ok()) return given;
  if (absl::IsDataLoss(written))
    return absl::UnavailableError(absl::StrCat(NameOf(digest), " arrived damaged"));
  return OfThisMachine(written);
}

}  // namespace orbweave
