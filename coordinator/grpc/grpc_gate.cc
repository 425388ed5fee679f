// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_gate.h"

#include "coordinator/grpc/grpc_peer.h"
#include "coordinator/grpc/grpc_status.h"
#include "coordinator/method_rights.h"

namespace orbweave {

grpc::Status GrpcGate::Process(const InputMetadata& metadata,
                               grpc::AuthContext* connection,
                               OutputMetadata*,
                               OutputMetadata*) {
  const absl::StatusOr<std::optional<Identity>> peer = PeerOf(*connection);
  if (!peer.ok()) return OnWire(peer.status());
  if (*peer) {
    const absl::Status standing = revocations_->Check(**peer, CertificateOf(*connection));
    if (!standing.ok()) return OnWire(standing);
  }
  const auto path = metadata.find(":path");
  const std::string_view method = path == metadata.end()
                                      ? std::string_view()
                                      : std::string_view(path->second.data(), path->second.size());
  return OnWire(CheckRight(method, *peer, fleet_));
}

}  // namespace orbweave
