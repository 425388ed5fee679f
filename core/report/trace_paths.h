// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/io/page/job_report.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// Which registered images of a model follow one another in a drive, and how far apart they are.
/// Fills report.paths and what report.each_model says of paths and steps, from report.images.
///
/// Images of a drive follow each other as in SequenceOfDrives. A path ends where its model left the
/// drive off: where LeftOffBehind finds a gap when the model's own places are taken as positions.
///
/// Names need not tell an order. A drive without capture times is in none where a quarter of its
/// images or more have more others nearer by than the one that is said to be next: twenty, or in
/// small models a quarter of all, three at least. A street that is driven once has none or one
/// there, one of several passes up to two of each; of places picked from a town every second has
/// dozens. Such a drive has no paths, and its steps are those to the nearest image of its model, of
/// 500 images at most.
void TracePaths(const ImageManifest& manifest, JobReport& report);

}  // namespace orbweave
