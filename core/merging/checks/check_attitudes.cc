// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/check_attitudes.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/merging/georeference/drive_attitudes.h"
#include "core/merging/georeference/estimate_gravity.h"

namespace orbweave {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kSigmas = 3.0;
// What a right model's own attitudes, and its down, are off.
constexpr double kModelSigma_deg = 1.0;
constexpr double kDownSigma_deg = 2.0;
// An angle that varies by less does not tell its sign, nor do fewer panoramas.
constexpr double kTelling_deg = 1.0;
constexpr size_t kFewest = 10;
constexpr double kClearlyBetter = 0.5;
constexpr size_t kDrivesShown = 5;

/// An angle by which a drive's panoramas are off.
struct Finding {
  double off_deg = 0.0;
  double limit_deg = 0.0;
  std::string sentence{};

  [[nodiscard]] double Ratio() const { return off_deg / limit_deg; }
};

/// Of the drive's panoramas, degrees.
struct TiltSeries {
  std::vector<double> stated{};
  std::vector<double> seen{};  ///< in the model

  /// Of each, as stated (sign 1) or with the other sign (-1).
  [[nodiscard]] std::vector<double> Differences(double sign) const {
    std::vector<double> differences;
    for (size_t i = 0; i < stated.size(); ++i)
      differences.push_back(std::remainder(sign * stated[i] - seen[i], 360.0));
    return differences;
  }
};

double MedianOf(std::vector<double> values) { return Quantile(std::move(values), 0.5); }

double ScatterOf(std::vector<double> values) {
  const double middle = MedianOf(values);
  for (double& value : values) value = std::abs(value - middle);
  return MedianOf(std::move(values));
}

std::string DriveName(const DriveAttitudes& drive, const ImageManifest& manifest) {
  return absl::StrCat("the drive of ", manifest.At(drive.images.front()).name);
}

/// By how much an angle is off that fits clearly better with the other sign.
std::optional<Finding> FindOtherSign(const TiltSeries& series, double mean_limit_deg) {
  if (series.stated.size() < kFewest) return std::nullopt;
  const std::vector<double> as_stated = series.Differences(1.0);
  const std::vector<double> turned = series.Differences(-1.0);
  const auto tells = [](double off_deg, double turned_deg, double limit_deg) {
    return off_deg > limit_deg && turned_deg < kClearlyBetter * off_deg;
  };
  if (tells(ScatterOf(as_stated), ScatterOf(turned), kTelling_deg))
    return Finding{ScatterOf(as_stated), kTelling_deg};
  const double mean_deg = std::abs(MedianOf(as_stated));
  if (tells(mean_deg, std::abs(MedianOf(turned)), mean_limit_deg))
    return Finding{mean_deg, mean_limit_deg};
  return std::nullopt;
}

/// What is wrong with the angles of a drive that states them, or what fits worst.
Finding JudgeStated(const DriveAttitudes& drive,
                    const std::map<ImageId, RegisteredImage>& images,
                    const ImageManifest& manifest) {
  TiltSeries pitch;
  TiltSeries roll;
  std::vector<Eigen::Vector3d> levelled;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < drive.images.size(); ++i) {
    const PosePrior& prior = manifest.At(drive.images[i]).prior;
    const Eigen::Vector3d down =
        images.at(drive.images[i]).cam_from_world.rotation * -Eigen::Vector3d::UnitZ();
    pitch.stated.push_back(*prior.pitch_deg);
    pitch.seen.push_back(-kDegPerRad * std::asin(std::clamp(down.z(), -1.0, 1.0)));
    roll.stated.push_back(*prior.roll_deg);
    roll.seen.push_back(kDegPerRad * std::atan2(down.x(), down.y()));
    levelled.emplace_back(drive.level_from_world[i] * -Eigen::Vector3d::UnitZ());
    mean += levelled.back();
  }
  const std::string name = DriveName(drive, manifest);
  const double stated_deg = kDegPerRad * *drive.stated_sigma_rad;
  const double mean_limit_deg = kSigmas * std::hypot(stated_deg, kDownSigma_deg);
  for (const auto& [angle, series] : {std::pair("pitch", &pitch), std::pair("roll", &roll)}) {
    std::optional<Finding> finding = FindOtherSign(*series, mean_limit_deg);
    if (!finding) continue;
    finding->sentence = absl::StrFormat(
        "the %s that %s states fits the model with the other sign, and is off by "
        "%.1f deg as it is: pitch up and roll clockwise are positive",
        angle,
        name,
        finding->off_deg);
    return *finding;
  }
  std::vector<double> off_deg;
  for (const Eigen::Vector3d& down : levelled)
    off_deg.push_back(kDegPerRad * AngleBetween(down, mean));
  Finding of_each{MedianOf(std::move(off_deg)), kSigmas * std::hypot(stated_deg, kModelSigma_deg)};
  of_each.sentence = absl::StrFormat(
      "pitch and roll that %s states are off by %.1f deg in the median, %.1f deg "
      "apart from the drive's mean being what their accuracies allow",
      name,
      of_each.off_deg,
      of_each.limit_deg);
  Finding of_mean{kDegPerRad * AngleBetween(mean, Eigen::Vector3d::UnitY()), mean_limit_deg};
  of_mean.sentence = absl::StrFormat(
      "pitch and roll that %s states are off by %.1f deg, all alike, where their "
      "accuracies allow %.1f: an axis is another one, or the sensor is not aligned "
      "with the pictures",
      name,
      of_mean.off_deg,
      of_mean.limit_deg);
  return of_each.Ratio() < of_mean.Ratio() ? of_mean : of_each;
}

/// "; not used: those of 3 of the 20 panoramas of ..., as less than half state both" or nothing.
std::string UnusedText(const std::vector<DriveAttitudes>& drives, const ImageManifest& manifest) {
  std::string text;
  size_t count = 0;
  for (const DriveAttitudes& drive : drives) {
    if (drive.stated_sigma_rad || drive.num_stating_any == 0 || ++count > kDrivesShown) continue;
    absl::StrAppendFormat(&text,
                          "%s%d of %d panoramas of %s",
                          count == 1 ? "" : ", ",
                          drive.num_stating_both,
                          drive.num_registered,
                          DriveName(drive, manifest));
  }
  if (count == 0) return "";
  if (count > kDrivesShown) absl::StrAppend(&text, ", ", count - kDrivesShown, " more");
  return absl::StrCat(
      "; not used where fewer than half of a drive state both pitch and roll: ", text, " do");
}

std::optional<CrossCheck> CheckStated(const std::vector<DriveAttitudes>& drives,
                                      const std::map<ImageId, RegisteredImage>& images,
                                      const ImageManifest& manifest) {
  const bool is_any = std::ranges::any_of(
      drives, [](const DriveAttitudes& drive) { return drive.num_stating_any > 0; });
  if (!is_any) return std::nullopt;
  CrossCheck check{.name = "stated_attitude", .unit = "deg"};
  std::optional<Finding> worst;
  size_t count = 0;
  for (const DriveAttitudes& drive : drives) {
    if (!drive.stated_sigma_rad) continue;
    Finding finding = JudgeStated(drive, images, manifest);
    count += drive.images.size();
    if (!worst || worst->Ratio() < finding.Ratio()) worst = std::move(finding);
  }
  check.sentence = "stated pitch and roll tell nothing of the model";
  if (worst) {
    check.value = worst->off_deg;
    check.limit = worst->limit_deg;
    const bool is_off = worst->off_deg > worst->limit_deg;
    if (is_off) check.level = CheckLevel::kDoubtful;
    check.sentence = is_off ? worst->sentence
                            : absl::StrFormat(
                                  "pitch and roll that %d panoramas state agree with the model, to "
                                  "%.1f deg where they fit worst",
                                  count,
                                  worst->off_deg);
  }
  check.sentence += UnusedText(drives, manifest);
  return check;
}

CrossCheck MountTilts(const std::vector<DriveAttitudes>& drives,
                      const Gravity& gravity,
                      const ImageManifest& manifest) {
  CrossCheck check{.name = "drive_mounts", .unit = "deg"};
  for (size_t k = 0; k < drives.size(); ++k) {
    const DriveAttitudes& drive = drives[k];
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Matrix3d& R : drive.level_from_world) mean -= R * Eigen::Vector3d::UnitZ();
    const double tilt_deg = kDegPerRad * AngleBetween(mean, Eigen::Vector3d::UnitY());
    check.value = std::max(check.value, tilt_deg);
    if (k >= kDrivesShown) continue;
    absl::StrAppendFormat(&check.sentence,
                          "%s%.1f deg (sigma %.1f) in %s%s",
                          k == 0 ? "cameras lean by " : ", ",
                          tilt_deg,
                          kDegPerRad * gravity.mount_sigma_rad.at(drive.drive),
                          DriveName(drive, manifest),
                          drive.stated_sigma_rad ? ", stated angles taken off" : "");
  }
  if (drives.size() > kDrivesShown) {
    absl::StrAppendFormat(&check.sentence,
                          ", and in %d more drives, by %.1f deg at most in all",
                          drives.size() - kDrivesShown,
                          check.value);
  }
  return check;
}

}  // namespace

std::vector<CrossCheck> CheckAttitudes(const std::map<ImageId, RegisteredImage>& images,
                                       const ImageManifest& manifest) {
  const Reconstruction model{.images = images};
  const std::optional<Gravity> gravity = EstimateGravity(model, manifest);
  if (!gravity) return {};
  const std::vector<DriveAttitudes> drives = AttitudesOfDrives(model, manifest);
  std::vector<CrossCheck> checks = {MountTilts(drives, *gravity, manifest)};
  if (std::optional<CrossCheck> stated = CheckStated(drives, images, manifest))
    checks.push_back(*std::move(stated));
  return checks;
}

}  // namespace orbweave
