// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_peer.h"

#include <grpc/grpc_security_constants.h>

#include <string_view>
#include <vector>

namespace orbweave {

absl::StatusOr<std::optional<Identity>> PeerOf(const grpc::AuthContext& connection) {
  if (CertificateOf(connection).empty()) return std::nullopt;
  std::vector<std::string_view> uris;
  for (const grpc::string_ref& uri : connection.FindPropertyValues(GRPC_PEER_URI_PROPERTY_NAME)) {
    const std::string_view text(uri.data(), uri.size());
    if (text.starts_with(kIdentityScheme)) uris.push_back(text);
  }
  absl::StatusOr<Identity> identity =
      uris.size() == 1 ? Identity::FromUri(uris[0])
                       : absl::InvalidArgumentError("not exactly one orbweave:// name");
  if (identity.ok()) return std::optional(*std::move(identity));
  return absl::PermissionDeniedError(
      "the certificate does not say who it is for: it needs one alternative name "
      "orbweave://FLEET/ROLE/NAME");
}

absl::StatusOr<Identity> CertifiedPeerOf(const grpc::AuthContext& connection) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::optional<Identity> peer, PeerOf(connection));
  if (peer) return *peer;
  return absl::UnauthenticatedError("this call needs a certificate");
}

std::string_view CertificateOf(const grpc::AuthContext& connection) {
  const auto certificates = connection.FindPropertyValues(GRPC_X509_PEM_CERT_PROPERTY_NAME);
  if (certificates.empty()) return {};
  return {certificates.front().data(), certificates.front().size()};
}

}  // namespace orbweave
