// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/grpc_blob_transfer.h"

#include <chrono>

#include "absl/strings/str_cat.h"
#include "proto/codec/coordinator_codec.h"
#include "worker/grpc_status.h"

namespace orbweave {
namespace {

void SetDeadline(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(30));
}

absl::Status ArrivedDamaged(const Digest& digest) {
  return absl::UnavailableError(absl::StrCat("blob ", digest.ToShortHex(), " arrived damaged"));
}

/// Sends `chunk` with the first piece and then the others, until that was all or the coordinator
/// wants no more. Errors: those of `next`.
absl::Status WritePieces(grpc::ClientWriter<v1::BlobChunk>& writer,
                         v1::BlobChunk chunk,
                         const NextPiece& next) {
  while (true) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string_view piece, next());
    chunk.set_data(piece.data(), piece.size());
    const bool goes_on = writer.Write(chunk);  // otherwise Finish says why
    if (piece.empty() || !goes_on) return absl::OkStatus();
    chunk.Clear();
  }
}

}  // namespace

absl::Status ReceiveBlob(v1::Coordinator::Stub& stub, const Digest& digest, const TakePiece& take) {
  grpc::ClientContext context;
  SetDeadline(context);
  v1::GetBlobRequest request;
  request.set_digest(ToProto(digest));
  const auto reader = stub.GetBlob(&context, request);
  DigestBuilder builder;
  absl::Status taken;
  v1::BlobChunk chunk;
  while (taken.ok() && reader->Read(&chunk)) {
    builder.Add(chunk.data());
    taken = take(chunk.data());
  }
  if (!taken.ok()) context.TryCancel();
  const absl::Status received = FromWire(reader->Finish());
  ORBWEAVE_RETURN_IF_ERROR(taken);
  ORBWEAVE_RETURN_IF_ERROR(received);
  return builder.Finish() == digest ? absl::OkStatus() : ArrivedDamaged(digest);
}

absl::Status SendBlob(v1::Coordinator::Stub& stub,
                      const Digest& digest,
                      uint64_t size_bytes,
                      const NextPiece& next) {
  grpc::ClientContext context;
  SetDeadline(context);
  v1::PutBlobReply reply;
  const auto writer = stub.PutBlob(&context, &reply);
  v1::BlobChunk first;
  first.set_digest(ToProto(digest));
  first.set_size_bytes(size_bytes);
  const absl::Status given = WritePieces(*writer, std::move(first), next);
  if (given.ok()) {
    writer->WritesDone();
  } else {
    context.TryCancel();
  }
  const absl::Status sent = FromWire(writer->Finish());
  ORBWEAVE_RETURN_IF_ERROR(given);
  return absl::IsDataLoss(sent) ? ArrivedDamaged(digest) : sent;
}

}  // namespace orbweave
