// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/dense_bulk_codec.h"
#include "proto/codec/dense_codec.h"
#include "tests/fuzz/seeds.h"
#include "tests/support/dense_values.h"

namespace orbweave {

void AddDenseSeeds(Seeds& seeds) {
  seeds["view_recipe"] = {EncodeViewRecipe(testing::SomeViewRecipe()).value()};
  seeds["chosen_sources"] = {EncodeChosenSources(testing::SomeChosenSources()).value()};
  seeds["depth_recipe"] = {EncodeDepthRecipe(testing::SomeDepthRecipe()).value()};
  seeds["dense_plan"] = {EncodeDensePlan(testing::SomeDensePlan()).value()};
  seeds["check_recipe"] = {EncodeCheckRecipe(testing::SomeCheckRecipe()).value()};
  seeds["fuse_recipe"] = {EncodeFuseRecipe(testing::SomeFuseRecipe()).value()};
  seeds["tile_runs"] = {EncodeTileRuns(testing::SomeTileRuns()).value()};
  seeds["tile_recipe"] = {EncodeTileRecipe(testing::SomeTileRecipe()).value()};
  seeds["depth_map"] = {EncodeDepthMap(testing::SomeDepthMap()).value()};
  seeds["surface_points"] = {EncodeSurfacePoints(testing::SomeSurfacePoints()).value()};
  seeds["dense_tile"] = {EncodeDenseTile(testing::SomeDenseTile()).value()};
}

}  // namespace orbweave
