// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/grants_codec.h"

#include <algorithm>

#include "proto/codec/coordinator_codec.h"

namespace orbweave {
namespace {

/// Names and tags of servers go into URLs and XML; longer ones nobody has.
constexpr size_t kLongestName = 2048;

absl::Status CheckName(const std::string& name) {
  const bool is_printable = std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~'; });
  if (is_printable && name.size() <= kLongestName) return absl::OkStatus();
  return absl::InvalidArgumentError("a name of an upload, or a tag, that no server gives");
}

absl::StatusOr<ObjectPart> PartFromProto(const v1::ObjectPart& proto) {
  ObjectPart part{
      .upload = proto.upload(), .number = proto.number(), .size_bytes = proto.size_bytes()};
  ORBWEAVE_RETURN_IF_ERROR(CheckName(part.upload));
  if (part.upload.empty() || part.number < 1 || part.number > kMostParts ||
      part.size_bytes > kMostPutBytes)
    return absl::InvalidArgumentError("a part of an object that no server takes");
  ORBWEAVE_ASSIGN_OR_RETURN(part.digest, DigestFromProto(proto.digest()));
  return part;
}

}  // namespace

v1::GrantBlobsRequest ToProto(const BlobQuestion& question) {
  v1::GrantBlobsRequest proto;
  proto.set_verb(static_cast<uint32_t>(question.verb));
  for (const WantedBlob& blob : question.blobs) {
    v1::WantedBlob& wanted = *proto.add_blobs();
    wanted.set_digest(ToProto(blob.digest));
    wanted.set_size_bytes(blob.size_bytes);
    if (question.verb != GrantVerb::kPutPart) continue;
    v1::ObjectPart& part = *wanted.mutable_part();
    part.set_upload(blob.part.upload);
    part.set_number(blob.part.number);
    part.set_digest(ToProto(blob.part.digest));
    part.set_size_bytes(blob.part.size_bytes);
  }
  return proto;
}

absl::StatusOr<BlobQuestion> FromProto(const v1::GrantBlobsRequest& proto) {
  if (proto.verb() > static_cast<uint32_t>(GrantVerb::kPutPart))
    return absl::InvalidArgumentError("a grant for something that nobody knows");
  BlobQuestion question{.verb = static_cast<GrantVerb>(proto.verb())};
  for (const v1::WantedBlob& wanted : proto.blobs()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, DigestFromProto(wanted.digest()));
    question.blobs.push_back({.digest = digest, .size_bytes = wanted.size_bytes()});
    if (question.verb != GrantVerb::kPutPart) continue;
    ORBWEAVE_ASSIGN_OR_RETURN(question.blobs.back().part, PartFromProto(wanted.part()));
  }
  return question;
}

v1::GrantBlobsReply ToProto(const std::vector<BlobGrant>& grants) {
  v1::GrantBlobsReply proto;
  for (const BlobGrant& grant : grants) {
    v1::BlobGrant& given = *proto.add_grants();
    given.set_where(static_cast<uint32_t>(grant.where));
    given.set_url(grant.object.url);
    for (const std::string& header : grant.object.headers) given.add_headers(header);
    given.set_upload(grant.upload);
    given.set_part_bytes(grant.part_bytes);
  }
  return proto;
}

absl::StatusOr<std::vector<BlobGrant>> FromProto(const v1::GrantBlobsReply& proto) {
  std::vector<BlobGrant> grants;
  for (const v1::BlobGrant& given : proto.grants()) {
    if (given.where() > static_cast<uint32_t>(BlobGrant::Where::kParts))
      return absl::InvalidArgumentError("a blob at a place that nobody knows");
    grants.push_back({.where = static_cast<BlobGrant::Where>(given.where()),
                      .object = {.url = given.url(),
                                 .headers = {given.headers().begin(), given.headers().end()}},
                      .upload = given.upload(),
                      .part_bytes = given.part_bytes()});
    const bool has_parts = grants.back().where == BlobGrant::Where::kParts;
    if (has_parts &&
        (given.upload().empty() || given.part_bytes() == 0 || given.part_bytes() > kMostPutBytes))
      return absl::InvalidArgumentError("parts of an object of no size");
  }
  return grants;
}

v1::FinishUploadRequest ToProto(const UploadEnd& end) {
  v1::FinishUploadRequest proto;
  proto.set_digest(ToProto(end.digest));
  proto.set_upload(end.upload);
  for (const std::string& etag : end.etags) proto.add_etags(etag);
  return proto;
}

absl::StatusOr<UploadEnd> FromProto(const v1::FinishUploadRequest& proto) {
  UploadEnd end{.upload = proto.upload(), .etags = {proto.etags().begin(), proto.etags().end()}};
  ORBWEAVE_ASSIGN_OR_RETURN(end.digest, DigestFromProto(proto.digest()));
  ORBWEAVE_RETURN_IF_ERROR(CheckName(end.upload));
  for (const std::string& etag : end.etags) ORBWEAVE_RETURN_IF_ERROR(CheckName(etag));
  if (end.upload.empty() || end.etags.size() > kMostParts)
    return absl::InvalidArgumentError("the end of an upload that no server has");
  return end;
}

}  // namespace orbweave
