// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/trace_paths.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/scene/left_off.h"
#include "core/scene/order_along_way.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

constexpr size_t kSample = 500;  // images of a drive that are asked for all others

/// The registered images of one drive in one model, in the order of the drive.
struct Leg {
  uint32_t model = 0;
  uint32_t drive = 0;
  std::vector<uint32_t> images{};         ///< of JobReport.images
  std::vector<Eigen::Vector3d> places{};  ///< of each
};

/// By model, then drive.
std::vector<Leg> LegsOf(const ImageManifest& manifest, const std::vector<ReportImage>& images) {
  std::map<std::pair<uint32_t, uint32_t>, Leg> legs;
  for (const auto& [drive, sequence] : SequenceOfDrives(manifest)) {
    for (const ImageId id : sequence) {
      const ReportImage& image = images[id.value];
      if (!image.registered || image.loose) continue;
      Leg& leg = legs[{image.model, drive}];
      leg.model = image.model;
      leg.drive = drive;
      leg.images.push_back(id.value);
      leg.places.push_back(image.centre_in_world);
    }
  }
  std::vector<Leg> sorted;
  for (auto& [place, leg] : legs) sorted.push_back(std::move(leg));
  return sorted;
}

/// A leg's places as positions without an error.
std::vector<PosePrior> AsPositions(const Leg& leg) {
  std::vector<PosePrior> positions(leg.places.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    positions[i].position_in_enu = leg.places[i];
    positions[i].horizontal_sigma_m = 0.0;
  }
  return positions;
}

std::vector<const PosePrior*> PointersTo(const std::vector<PosePrior>& positions) {
  std::vector<const PosePrior*> pointers;
  for (const PosePrior& position : positions) pointers.push_back(&position);
  return pointers;
}

/// Evenly spread places of a list of `size`, `kSample` at most.
std::vector<size_t> SampleOf(size_t size) {
  std::vector<size_t> sample;
  const size_t stride = (size + kSample - 1) / kSample;
  for (size_t i = 0; i < size; i += stride) sample.push_back(i);
  return sample;
}

std::set<uint32_t> DrivesWithoutOrder(const ImageManifest& manifest, const std::vector<Leg>& legs) {
  std::map<uint32_t, OrderVotes> votes;
  for (const Leg& leg : legs) votes[leg.drive].Add(VoteOnOrder(leg.places));
  std::set<uint32_t> drives;
  for (const auto& [drive, sequence] : SequenceOfDrives(manifest)) {
    if (TimedAmong(manifest, sequence).empty() && !votes[drive].AreInOrder()) drives.insert(drive);
  }
  return drives;
}

void AppendPaths(const Leg& leg, std::vector<ReportPath>& paths) {
  const std::vector<PosePrior> positions = AsPositions(leg);
  const std::vector<uint8_t> left_off = LeftOffBehind(PointersTo(positions));
  ReportPath path{.model = leg.model, .drive = leg.drive};
  for (size_t i = 0; i < leg.images.size(); ++i) {
    path.images.push_back(leg.images[i]);
    if (left_off[i] == 0 && i + 1 < leg.images.size()) continue;
    if (path.images.size() > 1) paths.push_back(path);
    path.images.clear();
  }
}

void AppendNearestSteps(const Leg& leg, std::vector<double>& steps) {
  if (leg.places.size() < 2) return;
  for (const size_t i : SampleOf(leg.places.size())) {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < leg.places.size(); ++k) {
      if (k != i) nearest = std::min(nearest, (leg.places[k] - leg.places[i]).norm());
    }
    steps.push_back(nearest);
  }
}

std::vector<double> StepsOf(const ReportPath& path, const std::vector<ReportImage>& images) {
  std::vector<double> steps;
  for (size_t i = 1; i < path.images.size(); ++i) {
    steps.push_back(
        (images[path.images[i]].centre_in_world - images[path.images[i - 1]].centre_in_world)
            .norm());
  }
  return steps;
}

}  // namespace

void TracePaths(const ImageManifest& manifest, JobReport& report) {
  const std::vector<Leg> legs = LegsOf(manifest, report.images);
  const std::set<uint32_t> without_order = DrivesWithoutOrder(manifest, legs);
  std::vector<std::vector<double>> steps(report.each_model.size());
  for (const Leg& leg : legs) {
    if (without_order.contains(leg.drive)) {
      report.each_model[leg.model].is_in_order = false;
      AppendNearestSteps(leg, steps[leg.model]);
    } else {
      AppendPaths(leg, report.paths);
    }
  }
  for (const ReportPath& path : report.paths) {
    for (const double step : StepsOf(path, report.images)) {
      report.each_model[path.model].path_length += step;
      steps[path.model].push_back(step);
    }
  }
  for (size_t model = 0; model < steps.size(); ++model)
    report.each_model[model].step_median = Quantile(std::move(steps[model]), 0.5);
}

}  // namespace orbweave
