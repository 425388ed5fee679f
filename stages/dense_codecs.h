// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proto/codec/dense_bulk_codec.h"
#include "proto/codec/dense_codec.h"
#include "stages/port.h"

/// Bytes of what the dense stages hand on.

namespace orbweave {

template <>
struct Codec<ViewRecipe> {
  static constexpr std::string_view kName = "view_recipe";
  static constexpr auto Encode = EncodeViewRecipe;
  static constexpr auto Decode = DecodeViewRecipe;
};

template <>
struct Codec<ChosenSources> {
  static constexpr std::string_view kName = "chosen_sources";
  static constexpr auto Encode = EncodeChosenSources;
  static constexpr auto Decode = DecodeChosenSources;
};

template <>
struct Codec<DepthRecipe> {
  static constexpr std::string_view kName = "depth_recipe";
  static constexpr auto Encode = EncodeDepthRecipe;
  static constexpr auto Decode = DecodeDepthRecipe;
};

template <>
struct Codec<DensePlan> {
  static constexpr std::string_view kName = "dense_plan";
  static constexpr auto Encode = EncodeDensePlan;
  static constexpr auto Decode = DecodeDensePlan;
};

template <>
struct Codec<DepthMap> {
  static constexpr std::string_view kName = "depth_map";
  static constexpr auto Encode = EncodeDepthMap;
  static constexpr auto Decode = DecodeDepthMap;
};

template <>
struct Codec<CheckRecipe> {
  static constexpr std::string_view kName = "check_recipe";
  static constexpr auto Encode = EncodeCheckRecipe;
  static constexpr auto Decode = DecodeCheckRecipe;
};

template <>
struct Codec<FuseRecipe> {
  static constexpr std::string_view kName = "fuse_recipe";
  static constexpr auto Encode = EncodeFuseRecipe;
  static constexpr auto Decode = DecodeFuseRecipe;
};

template <>
struct Codec<SurfacePoints> {
  static constexpr std::string_view kName = "surface_points";
  static constexpr auto Encode = EncodeSurfacePoints;
  static constexpr auto Decode = DecodeSurfacePoints;
};

template <>
struct Codec<TileRuns> {
  static constexpr std::string_view kName = "tile_runs";
  static constexpr auto Encode = EncodeTileRuns;
  static constexpr auto Decode = DecodeTileRuns;
};

template <>
struct Codec<TileRecipe> {
  static constexpr std::string_view kName = "tile_recipe";
  static constexpr auto Encode = EncodeTileRecipe;
  static constexpr auto Decode = DecodeTileRecipe;
};

template <>
struct Codec<DenseTile> {
  static constexpr std::string_view kName = "dense_tile";
  static constexpr auto Encode = EncodeDenseTile;
  static constexpr auto Decode = DecodeDenseTile;
};

}  // namespace orbweave
