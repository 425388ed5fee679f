// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/read_colmap_database.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/temporary_folder.h"

FUZZ_TARGET(colmap_database) {
  static const orbweave::TemporaryFolder folder;
  const auto database =
      orbweave::ReadColmapDatabase(folder.Write("database.db", orbweave::BytesOf(data, size)));
  if (!database.ok()) return;
  for (const orbweave::TwoViewGeometry& pair : database->pairs) {
    ORBWEAVE_CHECK(pair.pair.a < pair.pair.b && pair.pair.b.value < database->images.size());
    for (const orbweave::FeatureMatch& match : pair.inliers) {
      ORBWEAVE_CHECK(match.a < database->images[pair.pair.a.value].keypoints.size());
      ORBWEAVE_CHECK(match.b < database->images[pair.pair.b.value].keypoints.size());
    }
  }
}
