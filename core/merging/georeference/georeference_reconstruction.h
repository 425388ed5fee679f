// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/merging/georeference/georeference.h"
#include "core/partitioned_ba/global_options.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// Robust similarity from camera centres to their GNSS positions. Centres of a straight street
/// leave the roll about the street open, so gravity takes part (EstimateGravity, with its sigma):
/// first yaw, scale and translation of the upright model from random pairs of images (least squared
/// horizontal residuals, truncated), then all seven parameters by reweighted least squares with
/// gravity as one more observation (RefineGeoreference); then again without what drives have wrong
/// in common (FindDriveErrors), gravity weighing as much more as errors of heights that neighbours
/// share make GNSS weigh less: over a narrow street they would lay the model on its side. Without
/// gravity the similarity comes from EstimateSimilarity.
///
/// GNSS carries the scale when its scatter leaves the scale uncertain by 10 % at most and is
/// smaller than the extent of the centres (rms distance from their mean), and 70 % of the positions
/// agree within three sigmas, of what they state or of their scatter; a phone indoors fails. A
/// smaller majority that is none by chance (Log10FalseAlarms) is used and doubted
/// ("gnss_agreement"): a part of the model may have come out elsewhere, and lies better in the
/// frame of the others than in none. Drives of eight positions or more are judged without their
/// bias. Where GNSS does not carry the scale, or few agree, but it would fit the upright model's
/// likeness in a mirror, or runs smoothly along the sequence (MeasureGnssSmoothness) and far from
/// the model, the reason and a bad check ("gnss_mirrored", "gnss_against_model") say so. Loose
/// images take no part. `use` kOff: not attempted. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<Georeference> GeoreferenceReconstruction(
    const Reconstruction& reconstruction,
    const ImageManifest& manifest,
    GnssUse use,
    const StageContext& context);

}  // namespace orbweave
