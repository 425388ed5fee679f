// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_sequence_steps.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "core/base/quantile.h"
#include "core/scene/places_in_drives.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

constexpr double kDetourSteps = 4.0;
// Six standard deviations of three normal errors, whose distance has 1.54 as its median.
constexpr double kMedians = 4.0;
constexpr size_t kAround = 6;        // steps before and after that tell what a step is there
constexpr uint32_t kMaxMissing = 2;  // captures between neighbours
// With more of the street off its way than one in fifty nothing about it is to be believed.
constexpr double kBadShare = 0.02;

/// One image of a drive.
struct Stop {
  ImageId id{};
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> gnss{};
};

/// An image between two others.
struct Triple {
  ImageId id{};
  double detour = 0.0;
  double step = 0.0;  ///< as they are around
  double before = 0.0;
  double after = 0.0;
  Eigen::Vector3d bend = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> gnss_bend{};
  double gnss_jump = 0.0;  ///< by how much one of its two steps is longer by GNSS than in the model
};

std::vector<Stop> StopsOf(const std::vector<ImageId>& drive,
                          const std::map<ImageId, RegisteredImage>& images,
                          const ImageManifest& manifest,
                          bool georeferenced) {
  std::vector<Stop> stops;
  for (const ImageId id : drive) {
    const auto image = images.find(id);
    if (image == images.end() || image->second.loose) continue;
    Stop& stop = stops.emplace_back();
    stop.id = id;
    stop.centre = image->second.cam_from_world.Centre();
    if (georeferenced) stop.gnss = manifest.At(id).prior.position_in_enu;
  }
  return stops;
}

bool AreNeighbours(const PlacesInDrives& places, const Stop& a, const Stop& b) {
  const ImagePair pair{a.id, b.id};
  return places.AreOfOneStretch(pair) && places.CapturesBetween(pair) <= kMaxMissing + 1;
}

/// Three quarters of the steps around stop `i` are no longer; its own two do not count.
double StepAround(const PlacesInDrives& places, const std::vector<Stop>& stops, size_t i) {
  std::vector<double> steps;
  const size_t first = i > kAround ? i - kAround : 0;
  const size_t last = std::min(stops.size() - 1, i + kAround);
  for (size_t k = first; k < last; ++k) {
    if (k + 1 == i || k == i || !AreNeighbours(places, stops[k], stops[k + 1])) continue;
    steps.push_back((stops[k + 1].centre - stops[k].centre).norm());
  }
  return steps.size() < 2 ? 0.0 : Quantile(std::move(steps), 0.75);
}

void AddTriples(const PlacesInDrives& places,
                const std::vector<Stop>& stops,
                std::vector<Triple>& triples) {
  for (size_t i = 1; i + 1 < stops.size(); ++i) {
    const Stop& p = stops[i - 1];
    const Stop& n = stops[i + 1];
    if (!AreNeighbours(places, p, stops[i]) || !AreNeighbours(places, stops[i], n)) continue;
    Triple& triple = triples.emplace_back();
    triple.id = stops[i].id;
    triple.before = (stops[i].centre - p.centre).norm();
    triple.after = (n.centre - stops[i].centre).norm();
    triple.detour = triple.before + triple.after - (n.centre - p.centre).norm();
    triple.step = StepAround(places, stops, i);
    triple.bend = stops[i].centre - 0.5 * (p.centre + n.centre);
    if (!p.gnss || !stops[i].gnss || !n.gnss) continue;
    triple.gnss_bend = *stops[i].gnss - 0.5 * (*p.gnss + *n.gnss);
    triple.gnss_jump = std::max((*stops[i].gnss - *p.gnss).norm() - triple.before,
                                (*n.gnss - *stops[i].gnss).norm() - triple.after);
  }
}

/// What differences between the bends of the model and of GNSS stay below.
double LimitByGnss(const std::vector<Triple>& triples) {
  std::vector<double> apart;
  for (const Triple& triple : triples) {
    if (triple.gnss_bend) apart.push_back((triple.bend - *triple.gnss_bend).norm());
  }
  return apart.empty() ? 0.0 : kMedians * Quantile(std::move(apart), 0.5);
}

/// How far an image is off, and what it should stay within.
struct Displacement {
  double distance = 0.0;
  double limit = 0.0;
};

std::optional<Displacement> DisplacementOf(const Triple& triple, double limit_by_gnss) {
  const double bend = triple.bend.norm();
  if (triple.gnss_bend) {
    const double apart = (triple.bend - *triple.gnss_bend).norm();
    if (apart < 0.5 * bend) return std::nullopt;
    // Less than a step leaves the order of the images as it is.
    const double limit = std::max(limit_by_gnss, triple.step);
    const bool is_jump_of_gnss = triple.gnss_jump > limit || bend <= triple.gnss_bend->norm();
    if (triple.step > 0.0 && apart > limit && !is_jump_of_gnss) return Displacement{apart, limit};
  }
  if (triple.step > 0.0 && triple.detour > kDetourSteps * triple.step)
    return Displacement{bend, 0.5 * kDetourSteps * triple.step};
  return std::nullopt;
}

}  // namespace

CrossCheck CheckSequenceSteps(const std::map<ImageId, RegisteredImage>& images,
                              const ImageManifest& manifest,
                              bool georeferenced) {
  const char* unit = georeferenced ? "m" : "step";
  CrossCheck check{.name = "sequence_steps", .unit = unit};
  std::vector<Triple> triples;
  const PlacesInDrives places(manifest);
  for (const auto& [drive, ids] : SequenceOfDrives(manifest))
    AddTriples(places, StopsOf(ids, images, manifest, georeferenced), triples);
  if (triples.empty()) {
    check.sentence = "no three panoramas of a drive follow one another";
    return check;
  }
  const double limit_by_gnss = LimitByGnss(triples);
  std::vector<Displacement> off;
  for (const Triple& triple : triples)
    off.push_back(DisplacementOf(triple, limit_by_gnss).value_or(Displacement{}));
  size_t count = 0;
  const Triple* worst = nullptr;
  for (size_t i = 0; i < off.size(); ++i) {
    if (off[i].distance == 0.0) continue;
    // One displaced image bends the way at its neighbours too, by half as much.
    if (i > 0 && off[i - 1].distance > off[i].distance) continue;
    if (i + 1 < off.size() && off[i + 1].distance > off[i].distance) continue;
    ++count;
    if (off[i].distance <= check.value) continue;
    check.value = off[i].distance;
    check.limit = off[i].limit;
    worst = &triples[i];
  }
  char text[512];
  if (worst == nullptr) {
    std::snprintf(text,
                  sizeof text,
                  "all %zu panoramas between others of their drive lie on its way",
                  triples.size());
    check.sentence = text;
    return check;
  }
  const bool is_bad =
      count > 1 && static_cast<double>(count) > kBadShare * static_cast<double>(triples.size());
  check.level = is_bad ? CheckLevel::kBad : CheckLevel::kDoubtful;
  std::snprintf(text,
                sizeof text,
                "%zu of %zu panoramas lie off the way of their drive, first of all %s by %.1f %s "
                "(steps of %.1f and %.1f %s where others are %.1f): misplaced, unless the camera "
                "went there and back",
                count,
                triples.size(),
                manifest.At(worst->id).name.c_str(),
                check.value,
                unit,
                worst->before,
                worst->after,
                unit,
                worst->step);
  check.sentence = text;
  return check;
}

}  // namespace orbweave
