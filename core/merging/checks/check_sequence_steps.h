// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "core/scene/cross_check.h"
#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// "sequence_steps": whether the panoramas of each drive lie on a way that a camera can have gone,
/// in order of capture times where all of a drive have one, else of ids. An image is off the way
/// when going by it is a detour, |C_i - C_p| + |C_n - C_i| - |C_n - C_p| over its neighbours p and
/// n, of more than four steps as they are around there: turning back on the spot makes two, a turn
/// to the side less than one. Where all three have GNSS positions G and the model is
/// `georeferenced`, a = C_i - (C_p + C_n) / 2 is held against the same of G: when they agree to
/// half of a, the detour was real; when a - b stands out from those of all images (four times their
/// median) the image is off without being a detour of four steps. A jump of GNSS is not the
/// model's: then a is the smaller of the two, or one of the steps from p and to n is as much longer
/// by GNSS than in the model. Loose images take no part, and those beside a place where the drive
/// was left off (LeftOffBehind) are no neighbours. Value: how far the worst image is off, a or
/// a - b; in metres where georeferenced, else in units of the model, about a step. Time linear in
/// the drive but for sorting.
[[nodiscard]] CrossCheck CheckSequenceSteps(const std::map<ImageId, RegisteredImage>& images,
                                            const ImageManifest& manifest,
                                            bool georeferenced);

}  // namespace orbweave
