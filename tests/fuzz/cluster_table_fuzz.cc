// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/cluster_table.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(cluster_table) {
  const std::vector<std::string> images = {"a/1.jpg", "a/2.jpg", "b/1.jpg"};
  const auto clusters = orbweave::ReadClusterTable(orbweave::BytesOf(data, size), "table", images);
  if (!clusters.ok()) return;
  for (const std::string& image : images) ORBWEAVE_CHECK(!clusters->at(image).empty());
}
