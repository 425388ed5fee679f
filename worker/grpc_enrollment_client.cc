// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/grpc_enrollment_client.h"

#include <sys/stat.h>

#include <cerrno>
#include <chrono>

#include "orbweave/v1/enrollment.grpc.pb.h"
#include "security/certificate_request.h"
#include "security/join_token.h"
#include "security/secret_file.h"
#include "worker/coordinator_address.h"
#include "worker/grpc_channel.h"
#include "worker/grpc_status.h"

namespace orbweave {
namespace {

void SetDeadline(grpc::ClientContext& context) {
  constexpr std::chrono::seconds kQuick{30};
  context.set_deadline(std::chrono::system_clock::now() + kQuick);
}

}  // namespace

absl::Status Enroll(const std::string& address,
                    const std::string& token,
                    const std::string& name,
                    const TlsFolder& folder) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JoinClaims claims, ReadJoinToken(token));
  ORBWEAVE_ASSIGN_OR_RETURN(const CoordinatorAddress to, FindCoordinator(address));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string key, MakePrivateKey());
  // What can fail here does so before the token is spent.
  if (::mkdir(folder.path.c_str(), S_IRWXU) != 0 && errno != EEXIST)
    return absl::ErrnoToStatus(errno, "cannot make folder " + folder.path);
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(folder.AuthorityPath(), claims.authority_pem));
  ORBWEAVE_RETURN_IF_ERROR(WriteSecretFile(folder.KeyPath(), key));
  v1::EnrollRequest request;
  request.set_token(token);
  request.set_name(name);
  ORBWEAVE_ASSIGN_OR_RETURN(*request.mutable_request(), MakeCertificateRequest(key));
  const std::string fleet = to.known_by == KnownBy::kFleet ? claims.fleet : std::string();
  const auto stub =
      v1::Enrollment::NewStub(OpenChannelAsStranger(to.address, claims.authority_pem, fleet));
  grpc::ClientContext context;
  SetDeadline(context);
  v1::CertificateReply reply;
  ORBWEAVE_RETURN_IF_ERROR(FromWire(stub->Enroll(&context, request, &reply)));
  return WriteSecretFile(folder.CertificatePath(), reply.certificate());
}

absl::Status RenewCertificate(const std::string& address, const TlsFolder& folder) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CoordinatorAddress to, FindCoordinator(address));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string key, ReadSecretFile(folder.KeyPath()));
  v1::RenewRequest request;
  ORBWEAVE_ASSIGN_OR_RETURN(*request.mutable_request(), MakeCertificateRequest(key));
  const auto stub = v1::Enrollment::NewStub(OpenChannel(to.address, folder.path, to.known_by));
  grpc::ClientContext context;
  SetDeadline(context);
  v1::CertificateReply reply;
  ORBWEAVE_RETURN_IF_ERROR(FromWire(stub->Renew(&context, request, &reply)));
  return WriteSecretFile(folder.CertificatePath(), reply.certificate());
}

}  // namespace orbweave
