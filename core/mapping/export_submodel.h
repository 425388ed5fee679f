// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mapping/model/mapping_state.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// The state as a value: images by id, tracks sorted by name with the mean colour of their
/// features.
[[nodiscard]] Reconstruction ExportSubmodel(const MappingState& state);

}  // namespace orbweave
