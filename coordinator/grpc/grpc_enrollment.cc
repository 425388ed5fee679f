// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_enrollment.h"

#include "coordinator/grpc/grpc_peer.h"
#include "coordinator/grpc/grpc_status.h"

namespace orbweave {
namespace {

absl::Status NoEnrollment() {
  return absl::FailedPreconditionError(
      "this coordinator gives no certificates: its --tls folder has no ca.key and token.key");
}

}  // namespace

grpc::Status GrpcEnrollment::Enroll(grpc::ServerContext*,
                                    const v1::EnrollRequest* request,
                                    v1::CertificateReply* reply) {
  if (enrollment_service_ == nullptr) return OnWire(NoEnrollment());
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(
      *reply->mutable_certificate(),
      enrollment_service_->Enroll(request->token(), request->request(), request->name()));
  return grpc::Status::OK;
}

grpc::Status GrpcEnrollment::Renew(grpc::ServerContext* context,
                                   const v1::RenewRequest* request,
                                   v1::CertificateReply* reply) {
  if (enrollment_service_ == nullptr) return OnWire(NoEnrollment());
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Identity peer, CertifiedPeerOf(*context->auth_context()));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(*reply->mutable_certificate(),
                                 enrollment_service_->Renew(peer, request->request()));
  return grpc::Status::OK;
}

}  // namespace orbweave
