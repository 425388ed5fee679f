// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/match_images/match_run.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/features/hide_carrier.h"
#include "stages/codecs.h"
#include "stages/match_images/pair_seed.h"
#include "stages/stage_task.h"

namespace orbweave {
namespace {

/// An image without what goes along with its camera.
struct LoadedImage {
  PairSide side;
  std::vector<FeatureIndex> index;  ///< in the image's own features, of each of the side's
  Digest digest{};
};

absl::StatusOr<std::map<ImageId, LoadedImage>> LoadImages(const MatchRecipe& recipe,
                                                          BlobAccess& blobs) {
  std::map<ImageId, LoadedImage> images;
  for (const FeatureFile& file : recipe.images) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Features features, FetchBlob<Features>(file.features, blobs));
    SceneFeatures scene = HideCarrier(features, CellsOfCarrier(recipe.carriers, file.image));
    images.emplace(file.image,
                   LoadedImage{.side = PairSide(std::move(scene.features)),
                               .index = std::move(scene.index),
                               .digest = file.features});
  }
  return images;
}

/// Names features as the images themselves do.
void CountAllFeatures(const LoadedImage& a, const LoadedImage& b, TwoViewGeometry& geometry) {
  for (FeatureMatch& match : geometry.inliers) match = {a.index[match.a], b.index[match.b]};
}

StageContext PairContext(const StageContext& context, const LoadedImage& a, const LoadedImage& b) {
  StageContext pair_context = context;
  pair_context.seed = PairSeed(a.digest, b.digest);
  return pair_context;
}

bool MatchesExist(const MatchRecipe::Pair& pair, const LoadedImage& a, const LoadedImage& b) {
  return std::all_of(pair.matches.begin(), pair.matches.end(), [&](const FeatureMatch& match) {
    return match.a < a.side.features.size() && match.b < b.side.features.size();
  });
}

}  // namespace

absl::StatusOr<MatchedRun> MatchRun(const MatchRecipe& recipe,
                                    BlobAccess& blobs,
                                    const MatchOptions& match_options,
                                    const TwoViewOptions& two_view_options,
                                    const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images, LoadImages(recipe, blobs));
  MatchedRun run;
  size_t putative = 0;
  size_t done = 0;
  for (const MatchRecipe::Pair& pair : recipe.pairs) {
    const LoadedImage& a = images.at(pair.pair.a);
    const LoadedImage& b = images.at(pair.pair.b);
    if (!MatchesExist(pair, a, b)) {
      return absl::InvalidArgumentError(
          "match_images: a match names a keypoint that its image does not have");
    }
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry,
                              MatchImagePair(pair.pair,
                                             a.side,
                                             b.side,
                                             {pair.matches, pair.predicted},
                                             match_options,
                                             two_view_options,
                                             PairContext(context, a, b)));
    putative += geometry.num_putative;
    if (geometry.kind != TwoViewKind::kNone) {
      run.matched.push_back(WithoutMatches(geometry, a.side, b.side, two_view_options));
      CountAllFeatures(a, b, geometry);
      run.verified.push_back(std::move(geometry));
    }
    context.Report(++done, recipe.pairs.size(), "pairs");
  }
  run.report_json = nlohmann::json{
      {"pairs", recipe.pairs.size()},
      {"verified", run.verified.size()},
      {"putative",
       putative}}.dump();
  return run;
}

}  // namespace orbweave
