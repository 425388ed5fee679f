// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/artifacts/dense_records.h"
#include "core/base/status.h"
#include "core/dense/top_view.h"
#include "core/pipeline/blob_access.h"
#include "core/report/dense_report.h"
#include "core/scene/image_manifest.h"
#include "stages/job_reader.h"

namespace orbweave {

/// Of the panoramas' distances to their first sources, in units of the model; 1 without any.
[[nodiscard]] double MedianStep(const DensePlan& plan);

/// Looks at a cloud on earth with north to the top, at others along the mean of the panoramas'
/// upright axes. Its first pixels are a sixty-fourth of MedianStep.
[[nodiscard]] TopView ViewOfCloud(const DensePlan& plan, bool is_on_earth);

/// from_above.png in `folder`, with .pgw and .png.aux.xml in the UTM zone of `origin` where there
/// is one; returns the PNG's bytes, empty for an empty picture. Codes of WriteFileAtomically.
[[nodiscard]] absl::StatusOr<std::string> WriteFromAbove(
    const TopPicture& picture,
    const std::optional<GeodeticPosition>& origin,
    const std::filesystem::path& folder);

/// Panoramas evenly along the job that have a depth, at most eight, each above its checked depth
/// map; a panorama whose file is no longer what it was is not shown, its depth is.
[[nodiscard]] absl::StatusOr<std::vector<DensePictures::Depth>> DrawDepthMaps(
    JobReader& job,
    const DensePlan& plan,
    const ImageManifest& manifest,
    const DenseReport& report,
    BlobAccess& blobs);

}  // namespace orbweave
