// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_tls.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

#include "absl/strings/str_cat.h"
#include "coordinator/grpc/grpc_gate.h"

namespace orbweave {
namespace {

constexpr unsigned kLookAtFiles_s = 30;

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeTlsCredentials(
    const TlsFolder& folder, Strangers strangers, std::shared_ptr<RevocationList> revocations) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CertificateFacts own, CheckTlsFolder(folder));
  if (own.identity.role != Role::kCoordinator) {
    return absl::InvalidArgumentError(absl::StrCat(folder.path,
                                                   " holds the keys of a ",
                                                   std::string(RoleName(own.identity.role)),
                                                   ", not of a coordinator"));
  }
  grpc::experimental::TlsServerCredentialsOptions options(
      std::make_shared<grpc::experimental::FileWatcherCertificateProvider>(
          folder.KeyPath(), folder.CertificatePath(), folder.AuthorityPath(), kLookAtFiles_s));
  options.watch_root_certs();
  options.watch_identity_key_cert_pairs();
  options.set_cert_request_type(strangers == Strangers::kLetToEnrol
                                    ? GRPC_SSL_REQUEST_CLIENT_CERTIFICATE_AND_VERIFY
                                    : GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  std::shared_ptr<grpc::ServerCredentials> credentials =
      grpc::experimental::TlsServerCredentials(options);
  credentials->SetAuthMetadataProcessor(
      std::make_shared<GrpcGate>(own.identity.fleet, std::move(revocations)));
  return credentials;
}

}  // namespace orbweave
