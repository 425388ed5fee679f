// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

#include "security/handshake_probe.h"
#include "security/tls_folder.h"

namespace orbweave {

/// A channel to a coordinator. It connects when it is needed and again when it broke. Unix sockets,
/// and every address while `tls_folder` is empty, are plain; otherwise both sides prove who they
/// are, by the files of a TlsFolder, which are read again when they change.
[[nodiscard]] std::shared_ptr<grpc::Channel> OpenChannel(const std::string& address,
                                                         const std::string& tls_folder,
                                                         KnownBy known_by = KnownBy::kHost);

/// A channel on which the coordinator alone proves who it is, by an authority in `authority_pem`;
/// `fleet` not empty: that it is of this fleet, wherever it runs.
[[nodiscard]] std::shared_ptr<grpc::Channel> OpenChannelAsStranger(const std::string& address,
                                                                   const std::string& authority_pem,
                                                                   const std::string& fleet = "");

}  // namespace orbweave
