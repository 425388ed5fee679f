// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/grpc_channel.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_certificate_verifier.h>
#include <grpcpp/security/tls_credentials_options.h>

#include <algorithm>
#include <utility>

#include "security/identity.h"

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

/// Takes the certificate of any coordinator of a fleet; that it is by the fleet's authority has
/// been checked before.
class CoordinatorOfFleet final : public grpc::experimental::ExternalCertificateVerifier {
 public:
  explicit CoordinatorOfFleet(std::string fleet) : fleet_(std::move(fleet)) {}

  bool Verify(grpc::experimental::TlsCustomVerificationCheckRequest* request,
              std::function<void(grpc::Status)>,
              grpc::Status* outcome) override {
    const bool is_one = std::ranges::any_of(request->uri_names(), [this](grpc::string_ref uri) {
      const auto identity = Identity::FromUri({uri.data(), uri.size()});
      return identity.ok() && identity->role == Role::kCoordinator && identity->fleet == fleet_;
    });
    if (!is_one)
      *outcome = {grpc::StatusCode::UNAUTHENTICATED, "not a coordinator of fleet " + fleet_};
    return true;  // decided at once
  }
  void Cancel(grpc::experimental::TlsCustomVerificationCheckRequest*) override {}

 private:
  std::string fleet_;
};

void KnowByFleet(grpc::experimental::TlsChannelCredentialsOptions& options,
                 const std::string& fleet) {
  options.set_certificate_verifier(
      grpc::experimental::ExternalCertificateVerifier::Create<CoordinatorOfFleet>(fleet));
  options.set_check_call_host(false);
}

/// Of the folder's own certificate; empty where there is none, and then no coordinator is known.
std::string FleetOf(const TlsFolder& folder) {
  const absl::StatusOr<CertificateFacts> own = CheckTlsFolder(folder);
  return own.ok() ? own->identity.fleet : std::string();
}

std::shared_ptr<grpc::ChannelCredentials> CredentialsFrom(const TlsFolder& folder,
                                                          KnownBy known_by) {
  grpc::experimental::TlsChannelCredentialsOptions options;
  if (known_by == KnownBy::kFleet) KnowByFleet(options, FleetOf(folder));
  options.set_certificate_provider(
      std::make_shared<grpc::experimental::FileWatcherCertificateProvider>(
          folder.KeyPath(), folder.CertificatePath(), folder.AuthorityPath(), kLookAtFiles_s));
  options.watch_root_certs();
  options.watch_identity_key_cert_pairs();
  return grpc::experimental::TlsCredentials(options);
}

}  // namespace

std::shared_ptr<grpc::Channel> OpenChannel(const std::string& address,
                                           const std::string& tls_folder,
                                           KnownBy known_by) {
  const bool is_plain = tls_folder.empty() || address.starts_with("unix:");
  return grpc::CreateCustomChannel(
      address,
      is_plain ? grpc::InsecureChannelCredentials() : CredentialsFrom({tls_folder}, known_by),
      Arguments());
}

std::shared_ptr<grpc::Channel> OpenChannelAsStranger(const std::string& address,
                                                     const std::string& authority_pem,
                                                     const std::string& fleet) {
  grpc::experimental::TlsChannelCredentialsOptions options;
  options.set_certificate_provider(
      std::make_shared<grpc::experimental::StaticDataCertificateProvider>(authority_pem));
  options.watch_root_certs();
  if (!fleet.empty()) KnowByFleet(options, fleet);
  return grpc::CreateCustomChannel(
      address, grpc::experimental::TlsCredentials(options), Arguments());
}

}  // namespace orbweave
