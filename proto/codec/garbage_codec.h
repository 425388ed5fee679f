// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/coordinator_api.h"
#include "orbweave/v1/coordinator.pb.h"

namespace orbweave {

/// What a collection of garbage is asked and answers.
[[nodiscard]] v1::GarbageRequest ToProto(const GarbageOptions& options);
[[nodiscard]] GarbageOptions FromProto(const v1::GarbageRequest& proto);
[[nodiscard]] v1::GarbageReport ToProto(const GarbageReport& report);
[[nodiscard]] GarbageReport FromProto(const v1::GarbageReport& proto);

}  // namespace orbweave
