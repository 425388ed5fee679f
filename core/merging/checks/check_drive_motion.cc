// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_drive_motion.h"

#include <absl/strings/str_format.h>

#include <optional>
#include <span>
#include <vector>

#include "core/base/quantile.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

constexpr double kMaxAcceleration_m_s2 = 12.0;
constexpr double kMedians = 6.0;
constexpr double kMaxGap_s = 20.0;
/// The median of fewer tells nothing of times.
constexpr size_t kFewest = 5;

/// One image of a drive, with when and where it was taken.
struct Passage {
  ImageId id{};
  double time_s = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> position{};  ///< by GNSS
};

struct Deviation {
  ImageId id{};
  double off_m = 0.0;
  double driven_m = 0.0;  ///< what a carrier can be off
  double before_m_s = 0.0;
  double after_m_s = 0.0;
  bool is_confirmed = false;
};

std::vector<Passage> PassagesOf(std::span<const ImageId> sequence,
                                const std::map<ImageId, RegisteredImage>& images,
                                const ImageManifest& manifest) {
  std::vector<Passage> passages;
  for (const ImageId id : TimedAmong(manifest, sequence)) {
    const auto image = images.find(id);
    if (image == images.end() || image->second.loose) continue;
    passages.push_back({.id = id,
                        .time_s = *manifest.At(id).capture_time_s,
                        .centre = image->second.cam_from_world.Centre(),
                        .position = manifest.At(id).prior.position_in_enu});
  }
  return passages;
}

std::optional<Deviation> DeviationOf(const Passage& p, const Passage& i, const Passage& n) {
  const double before_s = i.time_s - p.time_s;
  const double after_s = n.time_s - i.time_s;
  if (!(before_s > 0.0) || !(after_s > 0.0) || before_s > kMaxGap_s || after_s > kMaxGap_s)
    return std::nullopt;
  const double share = before_s / (before_s + after_s);
  const Eigen::Vector3d bend = i.centre - p.centre - share * (n.centre - p.centre);
  Deviation deviation{.id = i.id,
                      .off_m = bend.norm(),
                      .driven_m = 0.5 * kMaxAcceleration_m_s2 * before_s * after_s,
                      .before_m_s = (i.centre - p.centre).norm() / before_s,
                      .after_m_s = (n.centre - i.centre).norm() / after_s};
  if (p.position && i.position && n.position) {
    const Eigen::Vector3d by_gnss = *i.position - *p.position - share * (*n.position - *p.position);
    deviation.is_confirmed = (bend - by_gnss).norm() < 0.5 * bend.norm();
  }
  return deviation;
}

/// Of the images between others of their drive.
std::vector<Deviation> DeviationsAlong(const std::vector<Passage>& passages) {
  std::vector<Deviation> deviations;
  for (size_t i = 1; i + 1 < passages.size(); ++i) {
    if (const auto deviation = DeviationOf(passages[i - 1], passages[i], passages[i + 1]))
      deviations.push_back(*deviation);
  }
  return deviations;
}

struct Findings {
  size_t asked = 0;
  size_t off = 0;
  std::optional<Deviation> worst{};
  double limit_m = 0.0;  ///< of the worst
};

void Judge(const std::vector<Deviation>& deviations, Findings& findings) {
  if (deviations.size() < kFewest) return;
  std::vector<double> sizes_m;
  for (const Deviation& each : deviations) sizes_m.push_back(each.off_m);
  const double usual_m = Quantile(std::move(sizes_m), 0.5);
  for (size_t i = 0; i < deviations.size(); ++i) {
    const Deviation& here = deviations[i];
    ++findings.asked;
    const double limit_m = here.driven_m + kMedians * usual_m;
    if (here.is_confirmed || here.off_m <= limit_m) continue;
    // One displaced image bends the way at its neighbours too, by half as much.
    if (i > 0 && deviations[i - 1].off_m > here.off_m) continue;
    if (i + 1 < deviations.size() && deviations[i + 1].off_m > here.off_m) continue;
    ++findings.off;
    if (findings.worst && findings.worst->off_m >= here.off_m) continue;
    findings.worst = here;
    findings.limit_m = limit_m;
  }
}

}  // namespace

CrossCheck CheckDriveMotion(const std::map<ImageId, RegisteredImage>& images,
                            const ImageManifest& manifest) {
  Findings findings;
  for (const auto& [drive, sequence] : SequenceOfDrives(manifest))
    Judge(DeviationsAlong(PassagesOf(sequence, images, manifest)), findings);
  CrossCheck check{.name = "drive_motion", .unit = "m"};
  if (findings.asked == 0) {
    check.sentence = "no five panoramas of a drive follow one another at known times";
    return check;
  }
  if (!findings.worst) {
    check.sentence = absl::StrFormat(
        "all %d panoramas between others of their drive can have been reached in their time",
        findings.asked);
    return check;
  }
  check.level = CheckLevel::kDoubtful;
  check.value = findings.worst->off_m;
  check.limit = findings.limit_m;
  check.sentence = absl::StrFormat(
      "%d of %d panoramas stand where no vehicle gets in their time, first of all %s by %.1f m "
      "(reached at %.1f and left at %.1f m/s): misplaced, or capture times are wrong",
      findings.off,
      findings.asked,
      manifest.At(findings.worst->id).name,
      findings.worst->off_m,
      findings.worst->before_m_s,
      findings.worst->after_m_s);
  return check;
}

}  // namespace orbweave
