// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/recipes_codec.h"

#include <algorithm>

#include "proto/codec/carrier_codec.h"
#include "proto/codec/pack.h"
#include "proto/codec/pack_matrices.h"
#include "proto/codec/plausible.h"
#include "proto/codec/predicted_pose_message.h"

namespace orbweave {
namespace {

template <typename Repeated>
absl::StatusOr<std::vector<FeatureFile>> FilesFromProto(const Repeated& proto) {
  std::vector<FeatureFile> files;
  for (const v1::FeatureFile& file : proto) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, codec::UnpackDigest(file.features()));
    files.push_back({ImageId(file.image()), digest});
  }
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      codec::Ascends(files, &FeatureFile::image), "recipe", "images are not in order"));
  return files;
}

template <typename Repeated>
void FilesToProto(const std::vector<FeatureFile>& files, Repeated* proto) {
  for (const FeatureFile& file : files) {
    v1::FeatureFile* out = proto->Add();
    out->set_image(file.image.value);
    out->set_features(codec::PackDigest(file.features));
  }
}

bool Lists(const std::vector<FeatureFile>& files, ImageId id) {
  return std::ranges::binary_search(files, id, {}, &FeatureFile::image);
}

bool ListsPair(const std::vector<FeatureFile>& files, const ImagePair& pair) {
  return pair.a < pair.b && Lists(files, pair.a) && Lists(files, pair.b);
}

using FixValues = Eigen::Matrix<double, 5, 1>;

void FixesToProto(const std::vector<PositionFix>& fixes, v1::ClusterRecipe& proto) {
  std::vector<ImageId> images;
  std::vector<FixValues> values;
  std::vector<uint8_t> of_drive;
  for (const PositionFix& fix : fixes) {
    images.push_back(fix.image);
    of_drive.push_back(fix.is_of_drive ? 1 : 0);
    values.emplace_back();
    values.back() << fix.position_in_enu, fix.horizontal_sigma_m, fix.vertical_sigma_m;
  }
  proto.set_fix_images(codec::Pack(images));
  proto.set_fixes(codec::PackMatrices(values));
  proto.set_fixes_of_drive(codec::Pack(of_drive));
}

absl::StatusOr<std::vector<PositionFix>> FixesFromProto(const v1::ClusterRecipe& proto,
                                                        const std::vector<FeatureFile>& files) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images,
                            codec::Unpack<ImageId>(proto.fix_images(), "images with positions"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto values,
      codec::UnpackMatrices<FixValues>(proto.fixes(), images.size(), "positions"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto of_drive,
      codec::Unpack<uint8_t>(proto.fixes_of_drive(), "positions borne out by their drive"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      of_drive.size() == images.size(), "cluster recipe", "not a word on each position"));
  std::vector<PositionFix> fixes;
  for (size_t i = 0; i < images.size(); ++i) {
    const FixValues& value = values[i];
    if (!codec::IsPlace(value.head<3>()) || !codec::IsSigma(value[3]) ||
        !codec::IsSigma(value[4]) || !Lists(files, images[i]))
      return absl::DataLossError("cluster recipe: a position that is none, or of no image");
    fixes.push_back({images[i], value.head<3>(), value[3], value[4], of_drive[i] != 0});
  }
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(images), "cluster recipe", "positions are not in order"));
  return fixes;
}

}  // namespace

absl::StatusOr<std::string> EncodeExtractRecipe(const ExtractRecipe& recipe) {
  v1::ExtractRecipe proto;
  proto.set_image(codec::PackDigest(recipe.image));
  proto.set_mask(codec::PackDigest(recipe.mask));
  proto.set_mask_ignores_white(recipe.mask_ignores_white);
  proto.set_wants_facades(recipe.wants_facades);
  return codec::Serialize(proto, "extract recipe");
}

absl::StatusOr<ExtractRecipe> DecodeExtractRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::ExtractRecipe proto,
                            codec::Parse<v1::ExtractRecipe>(bytes, "extract recipe"));
  ExtractRecipe recipe{.mask_ignores_white = proto.mask_ignores_white(),
                       .wants_facades = proto.wants_facades()};
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.image, codec::UnpackDigest(proto.image()));
  if (recipe.image.IsZero()) return absl::DataLossError("extract recipe: no image");
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.mask, codec::UnpackDigest(proto.mask()));
  return recipe;
}

absl::StatusOr<std::string> EncodeMatchRecipe(const MatchRecipe& recipe) {
  v1::MatchRecipe proto;
  FilesToProto(recipe.images, proto.mutable_images());
  for (const MatchRecipe::Pair& pair : recipe.pairs) {
    v1::MatchRecipe::Pair* out = proto.add_pairs();
    out->set_a(pair.pair.a.value);
    out->set_b(pair.pair.b.value);
    out->set_matches(codec::Pack(pair.matches));
    if (pair.predicted) codec::ToProto(*pair.predicted, out->mutable_predicted());
  }
  codec::ToProto(recipe.carriers, proto.mutable_carriers());
  return codec::Serialize(proto, "match recipe");
}

absl::StatusOr<MatchRecipe> DecodeMatchRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::MatchRecipe proto,
                            codec::Parse<v1::MatchRecipe>(bytes, "match recipe"));
  MatchRecipe recipe;
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.images, FilesFromProto(proto.images()));
  for (const v1::MatchRecipe::Pair& in : proto.pairs()) {
    MatchRecipe::Pair pair{.pair = {ImageId(in.a()), ImageId(in.b())}};
    ORBWEAVE_ASSIGN_OR_RETURN(pair.matches, codec::Unpack<FeatureMatch>(in.matches(), "matches"));
    if (in.has_predicted()) {
      ORBWEAVE_ASSIGN_OR_RETURN(pair.predicted, codec::FromProto(in.predicted()));
    }
    if (!ListsPair(recipe.images, pair.pair)) {
      return absl::DataLossError("match recipe: a pair out of order or without its images");
    }
    recipe.pairs.push_back(std::move(pair));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.carriers, codec::FromProto(proto.carriers()));
  for (const Carrier& carrier : recipe.carriers) {
    for (const ImageId id : carrier.images)
      if (!Lists(recipe.images, id))
        return absl::DataLossError("match recipe: carrier of no image");
  }
  return recipe;
}

absl::StatusOr<std::string> EncodeClusterRecipe(const ClusterRecipe& recipe) {
  v1::ClusterRecipe proto;
  FilesToProto(recipe.images, proto.mutable_images());
  proto.set_drives(codec::Pack(recipe.drives));
  proto.set_ranks(codec::Pack(recipe.ranks));
  proto.set_pairs(codec::Pack(recipe.pairs));
  for (const Digest& blob : recipe.matches) proto.add_matches(codec::PackDigest(blob));
  proto.set_cluster(recipe.cluster);
  proto.set_shared(codec::Pack(recipe.shared));
  FixesToProto(recipe.fixes, proto);
  return codec::Serialize(proto, "cluster recipe");
}

absl::StatusOr<ClusterRecipe> DecodeClusterRecipe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::ClusterRecipe proto,
                            codec::Parse<v1::ClusterRecipe>(bytes, "cluster recipe"));
  ClusterRecipe recipe{.cluster = proto.cluster()};
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.images, FilesFromProto(proto.images()));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.drives, codec::Unpack<uint32_t>(proto.drives(), "drives"));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.ranks, codec::Unpack<uint32_t>(proto.ranks(), "ranks"));
  ORBWEAVE_RETURN_IF_ERROR(codec::Expect(
      recipe.drives.size() == recipe.images.size() && recipe.ranks.size() == recipe.images.size(),
      "cluster recipe",
      "not one drive and rank for each image"));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.pairs, codec::Unpack<ImagePair>(proto.pairs(), "pairs"));
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.shared, codec::Unpack<ImageId>(proto.shared(), "shared images"));
  const auto lists_pair = [&](const ImagePair& pair) { return ListsPair(recipe.images, pair); };
  const auto lists = [&](ImageId id) { return Lists(recipe.images, id); };
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(recipe.pairs) && std::ranges::all_of(recipe.pairs, lists_pair),
                    "cluster recipe",
                    "a pair out of order or without its images"));
  ORBWEAVE_RETURN_IF_ERROR(
      codec::Expect(codec::Ascends(recipe.shared) && std::ranges::all_of(recipe.shared, lists),
                    "cluster recipe",
                    "a shared image out of order or not its own"));
  for (const std::string& blob : proto.matches()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, codec::UnpackDigest(blob));
    recipe.matches.push_back(digest);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(recipe.fixes, FixesFromProto(proto, recipe.images));
  return recipe;
}

}  // namespace orbweave
