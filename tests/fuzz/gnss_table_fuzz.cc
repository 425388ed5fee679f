// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>

#include "core/io/gnss/gnss_table.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(gnss_table) {
  const auto table = orbweave::ParseGnssTable(orbweave::BytesOf(data, size), "table");
  if (!table.ok()) return;
  ORBWEAVE_CHECK(!table->rows.empty());
  for (const orbweave::GnssRow& row : table->rows) {
    ORBWEAVE_CHECK(!row.name.empty() &&
                   row.geodetic.has_value() != row.position_in_local.has_value());
    if (row.position_in_local) ORBWEAVE_CHECK(row.position_in_local->allFinite());
    if (!row.geodetic) continue;
    ORBWEAVE_CHECK(std::abs(row.geodetic->latitude_deg) <= 90.0);
    ORBWEAVE_CHECK(std::abs(row.geodetic->longitude_deg) <= 180.0);
    ORBWEAVE_CHECK(std::isfinite(row.geodetic->altitude_m));
  }
}
