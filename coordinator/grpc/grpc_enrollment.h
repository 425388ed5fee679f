// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "coordinator/enrollment_service.h"
#include "orbweave/v1/enrollment.grpc.pb.h"

namespace orbweave {

/// EnrollmentService on the wire. Without a service every call is FailedPrecondition.
class GrpcEnrollment final : public v1::Enrollment::Service {
 public:
  explicit GrpcEnrollment(std::unique_ptr<EnrollmentService> enrollment_service)
      : enrollment_service_(std::move(enrollment_service)) {}

  grpc::Status Enroll(grpc::ServerContext*,
                      const v1::EnrollRequest*,
                      v1::CertificateReply*) override;
  grpc::Status Renew(grpc::ServerContext*, const v1::RenewRequest*, v1::CertificateReply*) override;

 private:
  std::unique_ptr<EnrollmentService> enrollment_service_;
};

}  // namespace orbweave
