// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/method_rights.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

constexpr std::array<MethodRight, 28> kRights = {{
    {.method = "/orbweave.v1.Coordinator/Join", .worker = true},
    {.method = "/orbweave.v1.Coordinator/LeaseTask", .worker = true},
    {.method = "/orbweave.v1.Coordinator/Heartbeat", .worker = true},
    {.method = "/orbweave.v1.Coordinator/CompleteTask", .worker = true},
    {.method = "/orbweave.v1.Coordinator/FailTask", .worker = true},
    {.method = "/orbweave.v1.Coordinator/Leave", .worker = true},

    {.method = "/orbweave.v1.Coordinator/SubmitJob", .client = true},
    {.method = "/orbweave.v1.Coordinator/GetJob", .client = true},
    {.method = "/orbweave.v1.Coordinator/ListJobs", .client = true},
    {.method = "/orbweave.v1.Coordinator/ListWorkers", .client = true},
    {.method = "/orbweave.v1.Coordinator/CountWantedSlots", .client = true},
    {.method = "/orbweave.v1.Coordinator/CancelJob", .client = true},
    {.method = "/orbweave.v1.Coordinator/GetOutcomes", .client = true},
    {.method = "/orbweave.v1.Coordinator/GetTimings", .client = true},
    {.method = "/orbweave.v1.Coordinator/GetCosts", .client = true},
    {.method = "/orbweave.v1.Coordinator/LinkFile", .client = true},

    {.method = "/orbweave.v1.Coordinator/StatBlobs", .worker = true, .client = true},
    {.method = "/orbweave.v1.Coordinator/GetBlob", .worker = true, .client = true},
    {.method = "/orbweave.v1.Coordinator/PutBlob", .worker = true, .client = true},
    {.method = "/orbweave.v1.Coordinator/GrantBlobs", .worker = true, .client = true},
    {.method = "/orbweave.v1.Coordinator/FinishUpload", .worker = true, .client = true},

    // An admin's.
    {.method = "/orbweave.v1.Coordinator/DrainWorkers"},
    {.method = "/orbweave.v1.Coordinator/StopCoordinator"},
    {.method = "/orbweave.v1.Coordinator/ForgetJob"},
    {.method = "/orbweave.v1.Coordinator/CollectGarbage"},

    {.method = "/orbweave.v1.Enrollment/Enroll", .stranger = true},
    {.method = "/orbweave.v1.Enrollment/Renew", .worker = true},

    {.method = "/grpc.health.v1.Health/Check", .worker = true, .client = true},
}};

bool IsAllowed(const MethodRight& right, Role role) {
  switch (role) {
    case Role::kAdmin:
      return true;
    case Role::kWorker:
      return right.worker || right.stranger;
    case Role::kClient:
      return right.client || right.stranger;
    case Role::kCoordinator:
      break;
  }
  return false;
}

}  // namespace

std::span<const MethodRight> MethodRights() { return kRights; }

absl::Status CheckRight(std::string_view method,
                        const std::optional<Identity>& peer,
                        std::string_view fleet) {
  const auto* const right = std::find_if(
      kRights.begin(), kRights.end(), [method](const auto& row) { return row.method == method; });
  const bool is_known = right != kRights.end();
  if (is_known && right->stranger && !peer) return absl::OkStatus();
  if (!peer) return absl::UnauthenticatedError("this call needs a certificate: give --tls");
  if (peer->fleet != fleet) {
    return absl::PermissionDeniedError(
        absl::StrCat(peer->ToUri(), " is not of this coordinator's fleet ", std::string(fleet)));
  }
  if (is_known && IsAllowed(*right, peer->role)) return absl::OkStatus();
  return absl::PermissionDeniedError(
      absl::StrCat("a ", std::string(RoleName(peer->role)), " may not call ", std::string(method)));
}

}  // namespace orbweave
