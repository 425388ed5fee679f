// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline/coordinator_api.h"
#include "orbweave/v1/coordinator.pb.h"

namespace orbweave {

/// The words of core/pipeline as messages, and back. What comes from the wire is checked here and
/// nowhere else: InvalidArgument when a digest is not 32 bytes long or an enumerator is unknown.

[[nodiscard]] std::string ToProto(const Digest& digest);
[[nodiscard]] absl::StatusOr<Digest> DigestFromProto(std::string_view bytes);
[[nodiscard]] absl::StatusOr<std::vector<Digest>> DigestsFromProto(
    const google::protobuf::RepeatedPtrField<std::string>& digests);

[[nodiscard]] v1::TaskSpec ToProto(const TaskSpec& spec);
[[nodiscard]] absl::StatusOr<TaskSpec> FromProto(const v1::TaskSpec& proto);
[[nodiscard]] v1::TaskResult ToProto(const TaskResult& result);
[[nodiscard]] absl::StatusOr<TaskResult> FromProto(const v1::TaskResult& proto);
[[nodiscard]] v1::TaskOutcome ToProto(const TaskOutcome& outcome);
[[nodiscard]] absl::StatusOr<TaskOutcome> FromProto(const v1::TaskOutcome& proto);
[[nodiscard]] v1::TaskTiming ToProto(const TaskTiming& timing);
[[nodiscard]] TaskTiming FromProto(const v1::TaskTiming& proto);
[[nodiscard]] v1::MeasuredTask ToProto(const MeasuredTask& task);
[[nodiscard]] MeasuredTask FromProto(const v1::MeasuredTask& proto);

[[nodiscard]] v1::JobSpec ToProto(const JobSpec& job);
[[nodiscard]] absl::StatusOr<JobSpec> FromProto(const v1::JobSpec& proto);
[[nodiscard]] v1::JobStatus ToProto(const JobStatus& status);
[[nodiscard]] absl::StatusOr<JobStatus> FromProto(const v1::JobStatus& proto);
[[nodiscard]] absl::StatusOr<JobState> JobStateFromProto(uint32_t state);
[[nodiscard]] v1::WorkerStatus ToProto(const WorkerStatus& worker);
[[nodiscard]] WorkerStatus FromProto(const v1::WorkerStatus& proto);

[[nodiscard]] v1::JoinRequest ToProto(const WorkerInfo& worker);
[[nodiscard]] absl::StatusOr<WorkerInfo> FromProto(const v1::JoinRequest& proto);
[[nodiscard]] v1::JoinReply ToProto(const JoinReply& reply);
[[nodiscard]] JoinReply FromProto(const v1::JoinReply& proto);
[[nodiscard]] v1::Lease ToProto(const Lease& lease);
[[nodiscard]] absl::StatusOr<Lease> FromProto(const v1::Lease& proto);
[[nodiscard]] v1::LeaseProgress ToProto(const LeaseProgress& progress);
[[nodiscard]] absl::StatusOr<LeaseProgress> FromProto(const v1::LeaseProgress& proto);
[[nodiscard]] v1::HeartbeatReply ToProto(const HeartbeatReply& reply);
[[nodiscard]] absl::StatusOr<HeartbeatReply> FromProto(const v1::HeartbeatReply& proto);

}  // namespace orbweave
