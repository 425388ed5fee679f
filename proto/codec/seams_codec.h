// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"
#include "core/merging/alignment/fit_seams.h"

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeSeamsOfCluster(const SeamsOfCluster& seams);
/// DataLoss: arrays that do not match, a pose that is no rigid motion, a
/// similarity or a covariance that is none, submodels out of order.
[[nodiscard]] absl::StatusOr<SeamsOfCluster> DecodeSeamsOfCluster(std::string_view bytes);

}  // namespace orbweave
