// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_headings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>

#include "core/graph/azimuth.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

// A direction by positions so far apart is good to 23 degrees.
constexpr double kTellingSigmas = 2.5;
// Twice that, and the tilt of a car; what two wrong pairs agree to by chance one time in four.
constexpr double kAgree_rad = std::numbers::pi / 4.0;
constexpr double kAgainst_rad = std::numbers::pi / 2.0;
constexpr size_t kFewest = 3;
// One edge of four may be wrong; a position that is off by a step turns a third.
constexpr double kTrusted = 0.75;
// Of a position that lies between its neighbours' as a street goes; two wrong pairs of four.
constexpr double kTrustedIfSmooth = 0.5;
constexpr double kSmoothSigmas = 3.0;

/// What an edge tells of one of its images.
struct Link {
  uint32_t edge = 0;
  uint32_t other = 0;
  double turn_rad = 0.0;            ///< heading here less heading there
  std::optional<double> heading{};  ///< by the edge's own step
};

using Links = std::vector<std::vector<Link>>;

/// Azimuth of the step from a to b, clockwise from north; nullopt where GNSS cannot tell.
std::optional<double> StepByGnss(const ViewEdge& edge, const ImageManifest& manifest) {
  const PosePrior& a = manifest.At(edge.pair.a).prior;
  const PosePrior& b = manifest.At(edge.pair.b).prior;
  const bool has_direction =
      edge.kind == TwoViewKind::kGeneral || edge.kind == TwoViewKind::kPlanar;
  if (!has_direction || !a.position_in_enu || !b.position_in_enu) return std::nullopt;
  const Vector3d step_m = *b.position_in_enu - *a.position_in_enu;
  const double sigma_m = std::hypot(a.horizontal_sigma_m, b.horizontal_sigma_m);
  if (!(step_m.head<2>().norm() > kTellingSigmas * sigma_m)) return std::nullopt;
  return std::atan2(step_m.x(), step_m.y());
}

Links LinksOf(const std::vector<ViewEdge>& edges, const ImageManifest& manifest) {
  Links links(manifest.images.size());
  for (uint32_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e].pair;
    const Rigid3& b_from_a = edges[e].b_from_a;
    const double turn_rad = TurnOf(b_from_a.rotation);
    Link at_a{.edge = e, .other = b.value, .turn_rad = turn_rad};
    Link at_b{.edge = e, .other = a.value, .turn_rad = -turn_rad};
    if (const std::optional<double> step = StepByGnss(edges[e], manifest)) {
      at_a.heading = *step - AzimuthInCamera(b_from_a.Centre());
      at_b.heading = *step - AzimuthInCamera(-b_from_a.translation);
    }
    links[a.value].push_back(at_a);
    links[b.value].push_back(at_b);
  }
  return links;
}

/// What edges of the image and of its neighbours tell of its heading.
std::vector<double> ToldOf(uint32_t image, const Links& links) {
  std::vector<double> told;
  for (const Link& link : links[image]) {
    if (link.heading) told.push_back(*link.heading);
    for (const Link& beyond : links[link.other]) {
      if (beyond.edge != link.edge && beyond.heading)
        told.push_back(*beyond.heading + link.turn_rad);
    }
  }
  return told;
}

std::optional<double> HeadingOf(uint32_t image, const Links& links) {
  const std::vector<double> told = ToldOf(image, links);
  std::optional<double> best;
  size_t most = std::max(kFewest - 1, told.size() / 2);
  for (const double heading : told) {
    const auto agreeing = static_cast<size_t>(std::ranges::count_if(
        told, [&](double each) { return AngleBetweenAzimuths(each, heading) < kAgree_rad; }));
    if (agreeing <= most) continue;
    most = agreeing;
    best = heading;
  }
  return best;
}

/// Whether the position lies halfway between those of the images before and after it in its drive,
/// as far as they are exact.
bool IsSmooth(uint32_t image, const ImageManifest& manifest, const PlacesInDrives& places) {
  const ImageRecord& here = manifest.images[image];
  const std::optional<ImageId> id_before = places.Before(here.id);
  const std::optional<ImageId> id_after = places.After(here.id);
  if (!id_before || !id_after) return false;
  const ImageRecord& before = manifest.At(*id_before);
  const ImageRecord& after = manifest.At(*id_after);
  const auto& [p, g, n] = std::tie(
      before.prior.position_in_enu, here.prior.position_in_enu, after.prior.position_in_enu);
  if (!p || !g || !n) return false;
  const double sigma_m = std::hypot(here.prior.horizontal_sigma_m,
                                    0.5 * before.prior.horizontal_sigma_m,
                                    0.5 * after.prior.horizontal_sigma_m);
  return (*g - 0.5 * (*p + *n)).head<2>().norm() <= kSmoothSigmas * sigma_m;
}

bool IsTrusted(uint32_t image,
               const Links& links,
               const std::vector<std::optional<double>>& headings,
               const ImageManifest& manifest,
               const PlacesInDrives& places) {
  size_t all = 0;
  size_t agreeing = 0;
  for (const Link& link : links[image]) {
    if (!link.heading || !headings[link.other]) continue;
    ++all;
    const double there = *link.heading - link.turn_rad;
    agreeing += AngleBetweenAzimuths(there, *headings[link.other]) < kAgree_rad ? 1U : 0U;
  }
  const double share = IsSmooth(image, manifest, places) ? kTrustedIfSmooth : kTrusted;
  return all > 0 && static_cast<double>(agreeing) >= share * static_cast<double>(all);
}

}  // namespace

EdgesByGnss DropEdgesAgainstHeadings(const std::vector<ViewEdge>& edges,
                                     const ImageManifest& manifest) {
  const Links links = LinksOf(edges, manifest);
  const PlacesInDrives places(manifest);
  std::vector<std::optional<double>> headings;
  for (uint32_t image = 0; image < links.size(); ++image)
    headings.push_back(HeadingOf(image, links));
  std::vector<int> against(edges.size(), 0);
  for (uint32_t image = 0; image < links.size(); ++image) {
    if (!headings[image] || !IsTrusted(image, links, headings, manifest, places)) continue;
    for (const Link& link : links[image]) {
      if (link.heading && AngleBetweenAzimuths(*link.heading, *headings[image]) > kAgainst_rad)
        ++against[link.edge];
    }
  }
  EdgesByGnss result;
  for (uint32_t e = 0; e < edges.size(); ++e) {
    if (against[e] < 2) {
      result.kept.push_back(edges[e]);
    } else {
      result.dropped.push_back(
          {edges[e].pair, "it leads the other way than GNSS", DropCause::kGnss});
    }
  }
  return result;
}

}  // namespace orbweave
