// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/registration/registration_log.h"

namespace orbweave {

struct GrowthReport {
  int num_local_adjustments = 0;
  int num_global_adjustments = 0;
};

/// From a seed to everything it can reach: registers the next best image, triangulates, adjusts
/// locally, and globally whenever images or points grew by options.global_growth; images that
/// failed are tried again when they see more, after a global adjustment, and at last with relaxed
/// limits. Ends with the final adjustment. Images that are not `available` are not touched.
[[nodiscard]] absl::StatusOr<GrowthReport> GrowSubmodel(MappingState& state,
                                                        std::span<const uint8_t> available,
                                                        const MappingOptions& options,
                                                        RegistrationLog& log,
                                                        const StageContext& context);

}  // namespace orbweave
