// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/auth_metadata_processor.h>

#include <memory>
#include <string>
#include <utility>

#include "security/revocations.h"

namespace orbweave {

/// The one place where callers with certificates are let in: every call of every service passes
/// CheckRight here before its message is read, and nobody does who is revoked.
class GrpcGate final : public grpc::AuthMetadataProcessor {
 public:
  GrpcGate(std::string fleet, std::shared_ptr<RevocationList> revocations)
      : fleet_(std::move(fleet)), revocations_(std::move(revocations)) {}

  [[nodiscard]] bool IsBlocking() const override { return false; }
  grpc::Status Process(const InputMetadata& metadata,
                       grpc::AuthContext* connection,
                       OutputMetadata* consumed,
                       OutputMetadata* reply) override;

 private:
  std::string fleet_;
  std::shared_ptr<RevocationList> revocations_;
};

}  // namespace orbweave
