// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/byte_stream.h"
#include "core/io/colmap/colmap_database.h"
#include "core/io/sqlite_connection.h"

namespace orbweave {

/// Our id of each image_id of the file.
[[nodiscard]] std::map<int64_t, ImageId> ImageIdsByDatabaseId(const ColmapDatabase& database);

/// Numbers of a blob; nullopt when absent, of another length or not finite.
template <size_t kCount>
[[nodiscard]] std::optional<std::array<double, kCount>> NumbersFromBlob(std::string_view blob) {
  if (blob.size() != kCount * sizeof(double)) return std::nullopt;
  std::array<double, kCount> values;
  ByteReader in(blob);
  for (double& value : values) {
    value = in.Take<double>();
    if (!std::isfinite(value)) return std::nullopt;
  }
  return values;
}

/// Whether `blob` is `rows` of `columns` numbers of `number_bytes` each, whatever a damaged file
/// says of them.
[[nodiscard]] inline bool IsTable(std::string_view blob,
                                  int64_t rows,
                                  int64_t columns,
                                  size_t number_bytes) {
  if (rows == 0 || columns <= 0) return rows == 0 && blob.empty();
  const size_t row_bytes = static_cast<size_t>(columns) * number_bytes;
  return rows > 0 && blob.size() % row_bytes == 0 &&
         blob.size() / row_bytes == static_cast<size_t>(rows);
}

/// Appends the pairs with matches of `table`, "two_view_geometries" or "matches", to
/// database.pairs, in our ids and sorted. The images and keypoints must be there already. A missing
/// table has no pairs.
[[nodiscard]] absl::Status ReadColmapPairs(const SqliteConnection& connection,
                                           const std::string& path,
                                           const std::string& table,
                                           ColmapDatabase& database);

}  // namespace orbweave
