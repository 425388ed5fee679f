// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "core/artifacts/dense_records.h"
#include "core/base/status.h"
#include "core/dense/top_view.h"
#include "core/io/gnss/utm_frame.h"
#include "core/io/points/write_las.h"
#include "core/report/dense_report.h"

namespace orbweave {

/// Writes a dense cloud into a folder, one tile after the other: tiles/X_Y.ply (X_Y_N.ply for piece
/// N of a tile of very many points) and cloud.las, in the UTM zone of `origin` where there is one;
/// counts into a report, and looks at it from above.
class CloudWriter {
 public:
  /// `view`: which has seen nothing so far.
  CloudWriter(std::filesystem::path folder,
              const std::optional<GeodeticPosition>& origin,
              TopView view);

  /// Tiles ascending by cell and piece. Codes of WriteFileAtomically.
  [[nodiscard]] absl::Status Add(const DenseTile& tile, DenseReport& report);
  /// cloud.las takes its place; tiles of an earlier run that `report` does not name are removed.
  [[nodiscard]] absl::Status Finish(const DenseReport& report);

  [[nodiscard]] TopPicture FromAbove() const { return view_.Picture(); }

 private:
  std::filesystem::path folder_;
  std::optional<UtmFrame> utm_{};
  std::optional<LasWriter> las_{};
  TopView view_;
};

}  // namespace orbweave
