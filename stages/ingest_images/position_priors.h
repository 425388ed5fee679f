// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/scene/image_manifest.h"
#include "stages/ingest_images/ingest_candidate.h"
#include "stages/ingest_images/ingest_options.h"

namespace orbweave {

/// Whether positions are local metres: those of the table decide, then any latitude and longitude.
[[nodiscard]] bool PositionsAreLocal(std::span<const IngestCandidate> candidates,
                                     const GnssTable& table);

/// What is known of an image's position and attitude: the table's row, else the image's header,
/// each with the accuracy stated there, else that of its fix type, else the options'. An altitude
/// that nobody knows is NaN, with a large sigma.
[[nodiscard]] PosePrior PriorOf(const IngestCandidate& candidate,
                                bool local,
                                const IngestOptions& options);

}  // namespace orbweave
