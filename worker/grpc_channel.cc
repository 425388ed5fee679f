// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/grpc_channel.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

namespace orbweave {
namespace {

constexpr int kMaxMessageBytes = 8 << 20;
constexpr unsigned kLookAtFiles_s = 30;

grpc::ChannelArguments Arguments() {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 10'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 5'000);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 200);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 3'000);  // a handshake on a busy machine
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 5'000);
  arguments.SetMaxReceiveMessageSize(kMaxMessageBytes);
  return arguments;
}

std::shared_ptr<grpc::ChannelCredentials> CredentialsFrom(const TlsFolder& folder) {
  grpc::experimental::TlsChannelCredentialsOptions options;
  options.set_certificate_provider(
      std::make_shared<grpc::experimental::FileWatcherCertificateProvider>(
          folder.KeyPath(), folder.CertificatePath(), folder.AuthorityPath(), kLookAtFiles_s));
  options.watch_root_certs();
  options.watch_identity_key_cert_pairs();
  return grpc::experimental::TlsCredentials(options);
}

}  // namespace

std::shared_ptr<grpc::Channel> OpenChannel(const std::string& address,
                                           const std::string& tls_folder) {
  const bool is_plain = tls_folder.empty() || address.starts_with("unix:");
  return grpc::CreateCustomChannel(
      address,
      is_plain ? grpc::InsecureChannelCredentials() : CredentialsFrom({tls_folder}),
      Arguments());
}

std::shared_ptr<grpc::Channel> OpenChannelAsStranger(const std::string& address,
                                                     const std::string& authority_pem) {
  grpc::SslCredentialsOptions options;
  options.pem_root_certs = authority_pem;
  return grpc::CreateCustomChannel(address, grpc::SslCredentials(options), Arguments());
}

}  // namespace orbweave
