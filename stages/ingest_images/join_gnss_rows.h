// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/scene/image_manifest.h"
#include "stages/ingest_images/ingest_candidate.h"

namespace orbweave {

/// Appends "3 images have no mask: a.jpg, b.jpg, c.jpg" to the warnings; nothing for no names.
void WarnOfNames(const std::vector<std::string>& names,
                 const char* one,
                 const char* many,
                 ImageManifest& manifest);

/// Gives each image its row (MatchNames). Rows and cells that could not be read and rows that mean
/// no image become warnings.
[[nodiscard]] std::vector<IngestCandidate> JoinGnssRows(
    const std::vector<const SourceImage*>& images,
    const GnssTable& table,
    const std::string& table_name,
    ImageManifest& manifest);

/// InvalidArgument: the table's positions fit the images' own EXIF only with latitude and longitude
/// exchanged.
[[nodiscard]] absl::Status CheckNotSwapped(const std::vector<IngestCandidate>& candidates,
                                           const std::string& table_name);

}  // namespace orbweave
