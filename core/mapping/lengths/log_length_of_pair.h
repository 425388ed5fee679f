// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Lengths agree whose logarithms are no further apart.
inline constexpr double kLengthTolerance = 0.15;
/// The same where one length is weighed against another: rays of right tracks tell lengths to a few
/// hundredths, so that a step that is a fifth too long has hardly a ray that agrees.
inline constexpr double kCloseTolerance = 0.06;
/// A pair's direction and the model's agree up to 60 degrees.
inline constexpr double kMinCosDirection = 0.5;
/// Fewer rays of one image say nothing of a pair; no pair counts with more than so many.
inline constexpr size_t kFewestRaysOfPair = 8;
inline constexpr double kMaxRaysOfPair = 200.0;

/// From the pair's first image to its second, both registered, as the model has them.
[[nodiscard]] Rigid3 PoseInModel(const MappingState& state, const LinkedPair& pair);

/// Whether both images are registered, the pair has a general geometry, and the model agrees with
/// its rotation up to 10 degrees.
[[nodiscard]] bool HasRotationOfModel(const MappingState& state, const LinkedPair& pair);

/// The logarithm of the length of the pair's baseline in the model, where that agrees with it in
/// rotation (HasRotationOfModel) and direction.
[[nodiscard]] std::optional<double> LogLengthOfPair(const MappingState& state,
                                                    const LinkedPair& pair);

}  // namespace orbweave
