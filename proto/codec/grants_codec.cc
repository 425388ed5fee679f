// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/grants_codec.h"

#include "proto/codec/coordinator_codec.h"

namespace orbweave {

v1::GrantBlobsRequest ToProto(const BlobQuestion& question) {
  v1::GrantBlobsRequest proto;
  proto.set_verb(static_cast<uint32_t>(question.verb));
  for (const WantedBlob& blob : question.blobs) {
    v1::WantedBlob& wanted = *proto.add_blobs();
    wanted.set_digest(ToProto(blob.digest));
    wanted.set_size_bytes(blob.size_bytes);
  }
  return proto;
}

absl::StatusOr<BlobQuestion> FromProto(const v1::GrantBlobsRequest& proto) {
  if (proto.verb() > static_cast<uint32_t>(GrantVerb::kPut))
    return absl::InvalidArgumentError("a grant for something that nobody knows");
  BlobQuestion question{.verb = static_cast<GrantVerb>(proto.verb())};
  for (const v1::WantedBlob& wanted : proto.blobs()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, DigestFromProto(wanted.digest()));
    question.blobs.push_back({digest, wanted.size_bytes()});
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
  }
  return proto;
}

absl::StatusOr<std::vector<BlobGrant>> FromProto(const v1::GrantBlobsReply& proto) {
  std::vector<BlobGrant> grants;
  for (const v1::BlobGrant& given : proto.grants()) {
    if (given.where() > static_cast<uint32_t>(BlobGrant::Where::kObject))
      return absl::InvalidArgumentError("a blob at a place that nobody knows");
    grants.push_back({.where = static_cast<BlobGrant::Where>(given.where()),
                      .object = {.url = given.url(),
                                 .headers = {given.headers().begin(), given.headers().end()}}});
  }
  return grants;
}

}  // namespace orbweave
