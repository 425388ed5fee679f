// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/io/gnss/gnss_table.h"
#include "core/io/images/image_sources.h"

namespace orbweave {

/// A source that takes part, with its table row if it has one.
struct IngestCandidate {
  const SourceImage* source = nullptr;
  const GnssRow* row = nullptr;

  /// The table's value, else that of the image's header.
  [[nodiscard]] std::optional<double> Either(
      std::optional<double> GnssRow::*of_row,
      std::optional<double> ImageMetadata::*of_header) const {
    if (row != nullptr && row->*of_row) return row->*of_row;
    return source->metadata.*of_header;
  }
};

}  // namespace orbweave
