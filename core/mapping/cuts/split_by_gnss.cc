// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/split_by_gnss.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/base/quantile.h"
#include "core/graph/disjoint_sets.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr double kTorn = 2.0;
constexpr double kSigmas = 3.0;

/// Two images of the model that have a point in common.
struct Link {
  ImagePair pair{};
  double length = 0.0;  ///< in the model
  std::optional<double> gnss_m{};
  double sigma_m = 0.0;
};

std::set<ImagePair> LinkedPairs(const Reconstruction& model) {
  std::set<ImagePair> pairs;
  for (const Track& track : model.tracks) {
    for (size_t i = 0; i < track.observations.size(); ++i) {
      for (size_t j = i + 1; j < track.observations.size(); ++j)
        pairs.insert({track.observations[i].ref.image, track.observations[j].ref.image});
    }
  }
  return pairs;
}

std::vector<Link> LinksOf(const ClusterProblem& problem, const Reconstruction& model) {
  std::map<ImageId, const PosePrior*> priors;
  for (const ClusterImage& image : problem.images) priors[image.id] = &image.prior;
  std::vector<Link> links;
  for (const ImagePair& pair : LinkedPairs(model)) {
    const PosePrior& a = *priors.at(pair.a);
    const PosePrior& b = *priors.at(pair.b);
    Link& link = links.emplace_back(Link{.pair = pair});
    link.length = (model.images.at(pair.b).cam_from_world.Centre() -
                   model.images.at(pair.a).cam_from_world.Centre())
                      .norm();
    if (!a.position_in_enu || !b.position_in_enu) continue;
    link.gnss_m = DistanceBetween(a, b);
    link.sigma_m = SigmaBetween(a, b);
  }
  return links;
}

/// Units of the model in a metre; 0 where GNSS does not tell.
double UsualScale(const std::vector<Link>& links) {
  std::vector<double> scales;
  for (const Link& link : links) {
    if (link.gnss_m && *link.gnss_m > kSigmas * link.sigma_m)
      scales.push_back(link.length / *link.gnss_m);
  }
  return Quantile(std::move(scales), 0.5);
}

bool IsTorn(const Link& link, double scale) {
  return scale > 0.0 && link.gnss_m &&
         link.length > kTorn * scale * (*link.gnss_m + kSigmas * link.sigma_m);
}

/// The tracks of some images of a model, as far as two of them see them.
Reconstruction PieceOf(const Reconstruction& model, const std::vector<ImageId>& images) {
  Reconstruction piece;
  for (const ImageId image : images) piece.images.insert(*model.images.find(image));
  for (const Track& track : model.tracks) {
    Track part = track;
    std::erase_if(part.observations,
                  [&](const Observation& seen) { return !piece.images.contains(seen.ref.image); });
    if (part.observations.size() >= 2) piece.tracks.push_back(std::move(part));
  }
  piece.SortTracks();
  return piece;
}

}  // namespace

std::vector<Reconstruction> SplitByGnss(const ClusterProblem& problem, Reconstruction model) {
  std::vector<ImageId> images;
  for (const auto& [id, image] : model.images) images.push_back(id);
  const auto place = [&](ImageId id) {
    return static_cast<uint32_t>(std::ranges::lower_bound(images, id) - images.begin());
  };
  const std::vector<Link> links = LinksOf(problem, model);
  const double scale = UsualScale(links);
  DisjointSets sets(static_cast<uint32_t>(images.size()));
  bool is_torn = false;
  for (const Link& link : links) {
    if (IsTorn(link, scale)) {
      is_torn = true;
    } else {
      sets.Unite(place(link.pair.a), place(link.pair.b));
    }
  }
  std::vector<Reconstruction> pieces;
  if (!is_torn) {
    pieces.push_back(std::move(model));
    return pieces;
  }
  std::vector<uint32_t> places(images.size());
  std::iota(places.begin(), places.end(), 0U);
  for (const std::vector<uint32_t>& of_set : sets.SetsOf(places)) {
    std::vector<ImageId> of_piece;
    for (const uint32_t at : of_set) of_piece.push_back(images[at]);
    pieces.push_back(PieceOf(model, of_piece));
  }
  return pieces;
}

}  // namespace orbweave
