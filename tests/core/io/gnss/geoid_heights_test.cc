// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss/geoid_heights.h"

#include <gmock/gmock.h>

#include "tests/core/io/geoid_grid.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

TEST(GeoidHeights, AddsTheHeightOfTheGeoid) {
  const TemporaryFolder folder;
  folder.Write("egm96-15.pgm", GeoidGrid(47.25));
  const auto geoid = GeoidHeights::Open(HeightDatum::kEgm96, folder.path());
  ASSERT_TRUE(geoid.ok()) << geoid.status();
  for (const auto& [latitude_deg, longitude_deg] :
       {std::pair(47.6, 8.5), std::pair(-33.0, -179.99), std::pair(90.0, 0.0)}) {
    const auto height_m = geoid->EllipsoidalHeight(latitude_deg, longitude_deg, 400.0);
    ASSERT_TRUE(height_m.ok()) << height_m.status();
    EXPECT_NEAR(*height_m, 447.25, 1e-9);
  }
}

TEST(GeoidHeights, SaysWhatToInstallWhereThereIsNoGrid) {
  const TemporaryFolder folder;
  folder.Write("egm96-15.pgm", GeoidGrid(47.25));
  const absl::Status status = GeoidHeights::Open(HeightDatum::kEgm2008, folder.path()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(status.message(), HasSubstr("geographiclib-get-geoids egm2008-5"));
  EXPECT_THAT(status.message(), HasSubstr(folder.path()));
}

TEST(GeoidHeights, DoesNotTakeADamagedGrid) {
  const TemporaryFolder folder;
  const std::string whole = GeoidGrid(47.25);
  folder.Write("egm96-15.pgm", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(GeoidHeights::Open(HeightDatum::kEgm96, folder.path()).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

}  // namespace
}  // namespace orbweave
