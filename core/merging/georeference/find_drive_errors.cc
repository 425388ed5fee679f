// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/find_drive_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/quantile.h"
#include "core/merging/georeference/correlated_noise.h"
#include "core/merging/georeference/drive_regression.h"

namespace orbweave {
namespace {

constexpr size_t kMinFixes = 12;  // twice the unknowns of a regression
// Where more positions are off, something else is wrong with them, as a mirror: what two legs of a
// street make of that looks like a shift of one of them.
constexpr double kMinAgreeingShare = 0.7;
constexpr size_t kMinOffsetFixes = 5;  // two that are far off do not carry a median of so many away
// Deviations (FitUncertainty::Bound). Estimates over their sigmas are normal to 10 % along
// corridors (960 without such errors, independent and alike over 50 to 400 m: none above 2.9
// ahead, 3.8 to the side), to 30 % of drives that are three or four stretches of six positions.
constexpr double kBelievedSigmas = 4.0;
constexpr double kAllowedForSigmas = 3.0;
// Receivers of one datum stay within this of each other on average over a drive: four sigmas of
// the difference of two offsets of 2 m, which is what a street canyon makes of a drive.
constexpr double kSameDatum_m = 12.0;
constexpr double kMadToSigma = 1.4826;
// From here on an undetermined shift along the street is worth a word.
constexpr double kTellingShift_m = 2.0;
// What one position tells alone may be its own error, or that of its image: of a straight street
// whose first panorama stands wrong, that alone says how late a clock is.
constexpr double kMostOfOnePosition = 0.5;
// No sigma of GNSS, which is never ten seconds late at 10 m/s: nothing tells the shift.
constexpr double kNoShift_m = 100.0;

std::string Fixed(double value, const std::string& unit) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.2f ", value);
  return text + unit;
}

std::string PositionsOf(const GnssDrive& drive) {
  return "GNSS positions of drive " + std::to_string(drive.drive);
}

// What the regression says of a shift along the way.
struct Shift {
  double ahead = 0.0;
  double sigma = 0.0;
  double believed = 0.0;  // beyond this
  double allowed_for = 0.0;
  double speed = 1.0;  // of a carrier as usual: m per unit of all these
  bool is_of_one_position = false;

  [[nodiscard]] bool IsBelieved() const {
    return !is_of_one_position && std::abs(ahead) > believed;
  }
  // Too little to be taken off, too much to be nothing.
  [[nodiscard]] bool IsAllowedFor() const {
    return !is_of_one_position && !IsBelieved() && std::abs(ahead) > allowed_for &&
           std::abs(ahead) * speed > kTellingShift_m;
  }
  [[nodiscard]] bool IsUnknown() const {
    return is_of_one_position || sigma * speed > kTellingShift_m;
  }
  // Nothing tells it: a straight street, say.
  [[nodiscard]] bool IsFree() const { return is_of_one_position || sigma * speed > kNoShift_m; }
};

CrossCheck ClockCheck(const GnssDrive& drive, const Shift& shift, double ahead) {
  const std::string unit = drive.has_times ? "s" : "m";
  const std::string size = Fixed(std::abs(ahead), unit) + (ahead < 0.0 ? " late" : " early") +
                           " along the way (sigma " + Fixed(shift.sigma, unit) + ")";
  const std::string cause = ": a clock that is off, or an antenna before or behind the camera";
  CrossCheck check{.name = "gnss_clock", .value = std::abs(ahead), .unit = unit};
  if (shift.IsBelieved()) {
    check.sentence = PositionsOf(drive) + " are " + size + cause + "; this is taken off";
  } else if (shift.IsAllowedFor()) {
    check.sentence = PositionsOf(drive) + " seem to be " + size + cause +
                     "; too uncertain to be taken off: sigmas allow for it";
  } else {
    const std::string sigma = shift.IsFree() ? "" : " (sigma " + Fixed(shift.sigma, unit) + ")";
    check.sentence = "a shift of GNSS along the way of drive " + std::to_string(drive.drive) +
                     " cannot be told from an offset of all its positions" + sigma +
                     ": sigmas do not hold it";
    check.value = 0.0;  // chance
    check.is_told = false;
  }
  return check;
}

CrossCheck LeverCheck(const GnssDrive& drive, double left_m, double sigma_m) {
  return {.name = "gnss_lever_arm",
          .value = std::abs(left_m),
          .unit = "m",
          .sentence = PositionsOf(drive) + " are " + Fixed(std::abs(left_m), "m") + " to the " +
                      (left_m > 0.0 ? "left" : "right") + " of the cameras (sigma " +
                      Fixed(sigma_m, "m") + "): an antenna beside the camera; this is taken off"};
}

// A drive whose shift can be asked for, and what it says of it.
struct AskedDrive {
  size_t drive = 0;  // position in the list
  DriveRegression regression;
  DriveRegression::Fit fit{};
};

constexpr std::array<int, 4> kFrameAlone = {DriveRegression::kEast,
                                            DriveRegression::kNorth,
                                            DriveRegression::kTurn,
                                            DriveRegression::kStretch};

bool IsOfOnePosition(const FitUncertainty& known, int unknown) {
  return known.largest_shares[unknown] > kMostOfOnePosition;
}

// `known`: how far the unknowns of the drive's fit are.
void TakeAlongTheWay(const GnssDrive& drive,
                     const AskedDrive& asked,
                     const FitUncertainty& known,
                     DriveErrors& errors,
                     std::vector<CrossCheck>& checks) {
  constexpr int kAhead = DriveRegression::kAhead;
  constexpr int kLeft = DriveRegression::kLeft;
  const Shift shift{.ahead = asked.fit.solution[kAhead],
                    .sigma = known.sigmas[kAhead],
                    .believed = known.Bound(kAhead, kBelievedSigmas),
                    .allowed_for = known.Bound(kAhead, kAllowedForSigmas),
                    .speed = asked.regression.speed(),
                    .is_of_one_position = IsOfOnePosition(known, kAhead)};
  const bool is_beside = !IsOfOnePosition(known, kLeft) &&
                         std::abs(asked.fit.solution[kLeft]) > known.Bound(kLeft, kBelievedSigmas);
  if (shift.IsBelieved() || is_beside) {
    std::vector<int> believed(kFrameAlone.begin(), kFrameAlone.end());
    if (shift.IsBelieved()) believed.push_back(kAhead);
    if (is_beside) believed.push_back(kLeft);
    const Eigen::VectorXd alone = asked.regression.Solve(believed).solution;
    errors.ahead = alone[kAhead];
    errors.left_m = alone[kLeft];
    errors.ahead_sigma = shift.IsBelieved() ? known.sigmas[kAhead] : 0.0;
    errors.left_sigma_m = is_beside ? known.sigmas[kLeft] : 0.0;
  }
  if (shift.IsAllowedFor()) errors.ahead_sigma = std::hypot(shift.ahead, shift.sigma);
  if (shift.IsBelieved() || shift.IsAllowedFor() || shift.IsUnknown())
    checks.push_back(ClockCheck(drive, shift, shift.IsBelieved() ? errors.ahead : shift.ahead));
  if (is_beside) checks.push_back(LeverCheck(drive, errors.left_m, known.sigmas[kLeft]));
}

// Clocks and lever arms. What makes errors of neighbours alike does so in all drives: a few short
// stretches of one cannot tell, as an offset of each is most of what they would show.
void FindAlongTheWay(std::span<const GnssDrive> drives,
                     const Sim3& enu_from_world,
                     std::vector<DriveErrors>& errors,
                     std::vector<CrossCheck>& checks) {
  std::vector<int> all(DriveRegression::kNumUnknowns);
  std::iota(all.begin(), all.end(), 0);
  std::vector<AskedDrive> asked;
  std::vector<NoiseAxis> noise;
  for (size_t i = 0; i < drives.size(); ++i) {
    if (drives[i].fixes.size() < kMinFixes) continue;
    AskedDrive drive{.drive = i, .regression = DriveRegression(drives[i], enu_from_world)};
    drive.fit = drive.regression.Solve(all);
    if (drive.fit.kept_share < kMinAgreeingShare) continue;
    noise.push_back(drive.regression.NoiseOf(drive.fit));
    asked.push_back(std::move(drive));
  }
  const std::vector<CorrelatedNoise> correlated = EstimateCorrelatedNoise(noise);
  for (size_t a = 0; a < asked.size(); ++a) {
    const size_t drive = asked[a].drive;
    TakeAlongTheWay(
        drives[drive], asked[a], UncertaintyOf(noise[a], correlated[a]), errors[drive], checks);
  }
}

// Median of GNSS minus model, without what is known of the way, per axis; along z of known heights.
Eigen::Vector3d MedianOffset(const GnssDrive& drive,
                             const DriveErrors& errors,
                             const Sim3& enu_from_world) {
  std::vector<double> axes[3];
  for (const DrivenFix& fix : drive.fixes) {
    const Eigen::Vector3d residual = fix.position_in_enu - ErrorAt(errors, fix, enu_from_world) -
                                     enu_from_world * fix.centre_in_world;
    for (int axis = 0; axis < (IsHeightKnown(fix.vertical_sigma_m) ? 3 : 2); ++axis)
      axes[axis].push_back(residual[axis]);
  }
  return {Quantile(std::move(axes[0]), 0.5),
          Quantile(std::move(axes[1]), 0.5),
          Quantile(std::move(axes[2]), 0.5)};
}

// A drive's offset and how much it counts.
struct Offset {
  size_t drive = 0;  // position in the list
  Eigen::Vector3d value_m = Eigen::Vector3d::Zero();
  size_t num_fixes = 0;
  bool is_height_known = true;  // of any fix
};

bool IsSameDatum(const Offset& a, const Offset& b) {
  const bool is_same_height = !a.is_height_known || !b.is_height_known ||
                              std::abs(a.value_m.z() - b.value_m.z()) <= kSameDatum_m;
  return (a.value_m - b.value_m).head<2>().norm() <= kSameDatum_m && is_same_height;
}

// The largest set of drives that agree with one of them: most drives, then most fixes, then first.
std::vector<size_t> LargestParty(const std::vector<Offset>& offsets) {
  std::vector<size_t> best;
  size_t best_fixes = 0;
  for (const Offset& candidate : offsets) {
    std::vector<size_t> party;
    size_t fixes = 0;
    for (size_t i = 0; i < offsets.size(); ++i) {
      if (!IsSameDatum(candidate, offsets[i])) continue;
      party.push_back(i);
      fixes += offsets[i].num_fixes;
    }
    if (std::pair(party.size(), fixes) <= std::pair(best.size(), best_fixes)) continue;
    best = std::move(party);
    best_fixes = fixes;
  }
  return best;
}

std::string Numbers(std::span<const GnssDrive> drives, const std::vector<size_t>& which) {
  std::string text;
  for (const size_t i : which) text += (text.empty() ? "" : ", ") + std::to_string(drives[i].drive);
  return text;
}

CrossCheck DatumCheck(std::span<const GnssDrive> drives,
                      const std::vector<size_t>& party,
                      const std::vector<size_t>& others,
                      const Eigen::Vector3d& apart_m,
                      bool is_majority) {
  CrossCheck check{.name = "gnss_datum",
                   .value = apart_m.norm(),
                   .limit = is_majority ? 0.0 : kSameDatum_m,  // none for what is taken off
                   .unit = "m",
                   .level = is_majority ? CheckLevel::kGood : CheckLevel::kDoubtful};
  check.sentence = "GNSS positions of drives " + Numbers(drives, others) + " lie " +
                   Fixed(apart_m.head<2>().norm(), "m") + " beside and " +
                   Fixed(std::abs(apart_m.z()), "m") + (apart_m.z() < 0.0 ? " below" : " above") +
                   " those of drives " + Numbers(drives, party) +
                   ": another datum or a receiver that is off. ";
  check.sentence +=
      is_majority ? "They are moved to where most drives are"
                  : "Which of them is right cannot be told; the model follows drives " +
                        Numbers(drives, party) + ": check the heights of the table (--height)";
  return check;
}

void FindDatum(std::span<const GnssDrive> drives,
               const Sim3& enu_from_world,
               std::vector<DriveErrors>& errors,
               std::vector<CrossCheck>& checks) {
  std::vector<Offset> offsets;
  for (size_t i = 0; i < drives.size(); ++i) {
    if (drives[i].fixes.size() < kMinOffsetFixes) continue;
    offsets.push_back({.drive = i,
                       .value_m = MedianOffset(drives[i], errors[i], enu_from_world),
                       .num_fixes = drives[i].fixes.size(),
                       .is_height_known = std::ranges::any_of(
                           drives[i].fixes, IsHeightKnown, &DrivenFix::vertical_sigma_m)});
  }
  const std::vector<size_t> party = LargestParty(offsets);
  if (party.size() == offsets.size()) return;
  Eigen::Vector3d datum_m = Eigen::Vector3d::Zero();
  std::vector<size_t> members;
  double num_heights = 0.0;
  for (const size_t i : party) {
    datum_m += offsets[i].value_m;
    num_heights += offsets[i].is_height_known ? 1.0 : 0.0;
    members.push_back(offsets[i].drive);
  }
  datum_m.head<2>() /= static_cast<double>(party.size());
  datum_m.z() /= std::max(num_heights, 1.0);
  std::vector<size_t> others;
  Eigen::Vector3d apart_m = Eigen::Vector3d::Zero();
  for (const Offset& offset : offsets) {
    if (std::ranges::binary_search(members, offset.drive)) continue;
    others.push_back(offset.drive);
    errors[offset.drive].offset_m = offset.value_m - datum_m;
    if (!offset.is_height_known || num_heights == 0.0) errors[offset.drive].offset_m.z() = 0.0;
    if (errors[offset.drive].offset_m.norm() > apart_m.norm())
      apart_m = errors[offset.drive].offset_m;
  }
  checks.push_back(DatumCheck(drives, members, others, apart_m, 2 * party.size() > offsets.size()));
}

}  // namespace

FoundDriveErrors FindDriveErrors(std::span<const GnssDrive> drives, const Sim3& enu_from_world) {
  FoundDriveErrors found;
  std::vector<DriveErrors> errors;
  for (const GnssDrive& drive : drives)
    errors.push_back({.drive = drive.drive, .has_times = drive.has_times});
  FindAlongTheWay(drives, enu_from_world, errors, found.checks);
  FindDatum(drives, enu_from_world, errors, found.checks);
  for (const DriveErrors& of_drive : errors) {
    if (of_drive.ahead_sigma != 0.0 || of_drive.left_sigma_m != 0.0 || !of_drive.offset_m.isZero())
      found.drives.push_back(of_drive);
  }
  return found;
}

}  // namespace orbweave
