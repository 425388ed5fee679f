// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/auth_metadata_processor.h>

#include <string>
#include <utility>

namespace orbweave {

/// The one place where callers with certificates are let in: every call of every service passes
/// CheckRight here before its message is read.
class GrpcGate final : public grpc::AuthMetadataProcessor {
 public:
  explicit GrpcGate(std::string fleet) : fleet_(std::move(fleet)) {}

  [[nodiscard]] bool IsBlocking() const override { return false; }
  grpc::Status Process(const InputMetadata& metadata,
                       grpc::AuthContext* connection,
                       OutputMetadata* consumed,
                       OutputMetadata* reply) override;

 private:
  std::string fleet_;
};

}  // namespace orbweave
