// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/dense/patch_match_round.h"
#include "core/dense/plane_field.h"

namespace orbweave {

/// How well planes, and the sky, explain what is seen around each cell of 2 x 2 pixels of a raster:
/// entry (face * cells + row) * cells + column of every vector, cells = face_px / 2.
struct PlaneEvidence {
  int cells = 0;
  std::vector<float> texture{};                   ///< variance of its patch, in variances of noise
  std::vector<std::vector<float>> correlation{};  ///< by plane, 0 ... 1; last, of the sky
};

/// One patch of weak texture says little about a plane; the patches within kEvidenceReach cells say
/// it together: the mean of their correlations, each with the weight of its texture up to
/// kFullTexture. `planes`: q.x = 1 in the camera frame.
[[nodiscard]] PlaneEvidence GatherEvidence(const PatchMatchContext& context,
                                           const std::vector<Eigen::Vector3f>& planes,
                                           PlaneField& field);

inline constexpr int kEvidenceReach = 6;
inline constexpr float kFullTexture = 6.0F;

}  // namespace orbweave
