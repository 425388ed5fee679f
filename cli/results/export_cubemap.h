// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "coordinator/coordinator.h"
#include "core/io/cubes/export_cube_faces.h"

namespace orbweave {

/// Writes the largest model of the finished job in `output` as pinhole images (CubeExport) into
/// `folder` and says what was written. FailedPrecondition: the job has no model; codes of
/// LastFinishedJob, FetchResults and CubeExport.
[[nodiscard]] absl::Status ExportCubemap(ClientApi& coordinator,
                                         const std::string& output,
                                         const std::string& folder,
                                         const CubeExportOptions& options);

/// The options' programs by their names "colmap", "nerfstudio", "openmvs" with commas between.
/// InvalidArgument: a name that is none of them.
[[nodiscard]] absl::Status SetCubeFormats(const std::string& names, CubeExportOptions& options);

}  // namespace orbweave
