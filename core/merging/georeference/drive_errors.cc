// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/drive_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/base/quantile.h"
#include "core/merging/georeference/correlated_noise.h"

namespace orbweave {
namespace {

constexpr size_t kMinFixes = 12;       // twice the unknowns of a regression
constexpr size_t kMinOffsetFixes = 5;  // two that are far off do not carry a median of so many away
// Estimates over their sigmas are normal to 10 % (960 corridors without such errors, independent
// and alike over 50 to 400 m: none above 2.9 ahead, 3.8 to the side).
constexpr double kBelievedSigmas = 4.0;
constexpr double kDoubtedSigmas = 3.0;
constexpr int kReweightings = 10;
// Sigma of shifts and errors before anything is measured: no receiver is worse.
constexpr double kAnything_m = 1000.0;
// Receivers of one datum stay within this of each other on average over a drive: four sigmas of
// the difference of two offsets of 2 m, which is what a street canyon makes of a drive.
constexpr double kSameDatum_m = 12.0;
constexpr double kMadToSigma = 1.4826;
// From here on an undetermined shift along the street is worth a word.
constexpr double kTellingShift_m = 2.0;

// Unknowns of a drive's regression.
enum Unknown { kEast, kNorth, kTurn, kStretch, kAhead, kLeft, kNumUnknowns };
using Row = Eigen::Matrix<double, 2, kNumUnknowns>;

Eigen::Vector2d LeftOf(const Eigen::Vector3d& travel) {
  const double length = travel.head<2>().norm();
  if (!(length > 0.0)) return Eigen::Vector2d::Zero();
  return {-travel.y() / length, travel.x() / length};
}

Eigen::Vector3d TravelInEnu(const DrivenFix& fix, bool has_times, const Sim3& enu_from_world) {
  return (has_times ? enu_from_world.scale : 1.0) * (enu_from_world.rotation * fix.travel);
}

std::string Fixed(double value, const std::string& unit) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.2f ", value);
  return text + unit;
}

std::string PositionsOf(const GnssDrive& drive) {
  return "GNSS positions of drive " + std::to_string(drive.drive);
}

// The regression of one drive.
class Regression {
 public:
  Regression(const GnssDrive& drive, const Sim3& enu_from_world) : drive_(drive) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const DrivenFix& fix : drive.fixes)
      centres_.emplace_back((enu_from_world * fix.centre_in_world).head<2>());
    for (const Eigen::Vector2d& centre : centres_) middle += centre;
    middle /= static_cast<double>(centres_.size());
    for (size_t i = 0; i < centres_.size(); ++i) extent_m_ += (centres_[i] - middle).squaredNorm();
    extent_m_ = std::max(std::sqrt(extent_m_ / static_cast<double>(centres_.size())), 1e-6);
    for (size_t i = 0; i < centres_.size(); ++i) {
      const DrivenFix& fix = drive.fixes[i];
      const Eigen::Vector2d at = (centres_[i] - middle) / extent_m_;
      const Eigen::Vector2d travel = TravelInEnu(fix, drive.has_times, enu_from_world).head<2>();
      const Eigen::Vector2d left =
          LeftOf(fix.travel.isZero() ? fix.travel : enu_from_world.rotation * fix.travel);
      Row row;
      row << 1.0, 0.0, -at.y(), at.x(), travel.x(), left.x(),  //
          0.0, 1.0, at.x(), at.y(), travel.y(), left.y();
      rows_.push_back(row);
      residuals_.emplace_back(fix.position_in_enu.head<2>() - centres_[i]);
      speeds_.push_back(travel.norm());
      sigmas_m_.push_back(fix.horizontal_sigma_m);
    }
    speed_ = std::max(Quantile(speeds_, 0.5), 1e-9);
    prior_.setConstant(1.0 / (kAnything_m * kAnything_m));
    prior_[kAhead] *= speed_ * speed_;
  }

  // The unknowns in `free`, the others zero; Cauchy's weights at the scatter found.
  Eigen::VectorXd Solve(const std::vector<int>& free) {
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(kNumUnknowns);
    for (int iteration = 0; iteration < kReweightings; ++iteration) {
      const std::vector<double> errors = Errors(solution);
      scale_m_ = std::max(Quantile(errors, 0.5) / 1.1774, 1e-6);  // median of Rayleigh's
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kNumUnknowns, kNumUnknowns);
      Eigen::VectorXd b = Eigen::VectorXd::Zero(kNumUnknowns);
      for (size_t i = 0; i < rows_.size(); ++i) {
        const double weight = 1.0 / (scale_m_ * scale_m_ + errors[i] * errors[i]);
        A += weight * rows_[i].transpose() * rows_[i];
        b += weight * rows_[i].transpose() * residuals_[i];
      }
      A.diagonal() += prior_;
      const auto n = static_cast<Eigen::Index>(free.size());
      Eigen::MatrixXd small(n, n);
      Eigen::VectorXd rhs(n);
      for (Eigen::Index j = 0; j < n; ++j) {
        rhs[j] = b[free[static_cast<size_t>(j)]];
        for (Eigen::Index k = 0; k < n; ++k)
          small(j, k) = A(free[static_cast<size_t>(j)], free[static_cast<size_t>(k)]);
      }
      const Eigen::VectorXd found = small.ldlt().solve(rhs);
      for (Eigen::Index j = 0; j < n; ++j) solution[free[static_cast<size_t>(j)]] = found[j];
    }
    return solution;
  }

  // Sigmas of all unknowns about `solution`, errors as correlated as they are.
  [[nodiscard]] Eigen::VectorXd Sigmas(const Eigen::VectorXd& solution) const {
    std::vector<NoiseRun> runs(2);
    const std::vector<double> errors = Errors(solution);
    std::vector<size_t> kept;
    for (size_t i = 0; i < errors.size(); ++i) {
      if (errors[i] <= 3.5 * scale_m_) kept.push_back(i);
    }
    const auto m = static_cast<Eigen::Index>(kept.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kNumUnknowns, kNumUnknowns);
    double squares = 0.0;
    const double claimed_m = Quantile(sigmas_m_, 0.5);
    for (int axis = 0; axis < 2; ++axis) {
      NoiseRun& run = runs[static_cast<size_t>(axis)];
      run.design.resize(m, kNumUnknowns);
      run.residuals.resize(m);
      for (Eigen::Index j = 0; j < m; ++j) {
        const size_t i = kept[static_cast<size_t>(j)];
        run.places.push_back(drive_.fixes[i].way);
        run.design.row(j) = rows_[i].row(axis) / claimed_m;
        run.residuals[j] = (residuals_[i] - rows_[i] * solution)[axis] / claimed_m;
      }
      A += run.design.transpose() * run.design;
      squares += run.residuals.squaredNorm();
    }
    const double redundancy = std::max(2.0 * static_cast<double>(m - kNumUnknowns / 2), 1.0);
    const double variance = squares / redundancy;
    const Eigen::VectorXd information = std::max(variance, 1e-12) * prior_;
    const CorrelatedNoise noise =
        EstimateCorrelatedNoise({{.runs = std::move(runs), .information = information}}).front();
    A.diagonal() += information;
    const Eigen::MatrixXd covariance =
        variance * A.ldlt().solve(Eigen::MatrixXd::Identity(kNumUnknowns, kNumUnknowns));
    return covariance.diagonal().cwiseMax(0.0).cwiseProduct(noise.inflations).cwiseSqrt();
  }

  [[nodiscard]] double speed() const { return speed_; }

 private:
  [[nodiscard]] std::vector<double> Errors(const Eigen::VectorXd& solution) const {
    std::vector<double> errors;
    for (size_t i = 0; i < rows_.size(); ++i)
      errors.push_back((residuals_[i] - rows_[i] * solution).norm());
    return errors;
  }

  const GnssDrive& drive_;
  std::vector<Eigen::Vector2d> centres_{};  // of the model
  std::vector<Row> rows_{};
  std::vector<Eigen::Vector2d> residuals_{};
  std::vector<double> speeds_{};
  std::vector<double> sigmas_m_{};
  Eigen::Matrix<double, kNumUnknowns, 1> prior_{};
  double extent_m_ = 0.0;
  double speed_ = 1.0;
  double scale_m_ = 1.0;
};

// What the regression says of a shift along the way.
struct Shift {
  double ahead = 0.0;
  double sigma = 0.0;
  double speed = 1.0;  // of a carrier as usual: m per unit of both

  [[nodiscard]] bool IsBelieved() const { return std::abs(ahead) > kBelievedSigmas * sigma; }
  [[nodiscard]] bool IsDoubted() const {
    return !IsBelieved() && std::abs(ahead) > kDoubtedSigmas * sigma &&
           std::abs(ahead) * speed > kTellingShift_m;
  }
  [[nodiscard]] bool IsUnknown() const { return sigma * speed > kTellingShift_m; }
};

CrossCheck ClockCheck(const GnssDrive& drive, const Shift& shift, double ahead) {
  const std::string unit = drive.has_times ? "s" : "m";
  const std::string size = Fixed(std::abs(ahead), unit) + (ahead < 0.0 ? " late" : " early") +
                           " along the way (sigma " + Fixed(shift.sigma, unit) + ")";
  const std::string cause = ": a clock that is off, or an antenna before or behind the camera";
  CrossCheck check{.name = "gnss_clock",
                   .value = std::abs(ahead),
                   .limit = kDoubtedSigmas * shift.sigma,
                   .unit = unit};
  if (shift.IsBelieved()) {
    check.limit = 0.0;  // none for what is taken off
    check.sentence = PositionsOf(drive) + " are " + size + cause + "; this is taken off";
  } else if (shift.IsDoubted()) {
    check.level = CheckLevel::kDoubtful;
    check.sentence = PositionsOf(drive) + " seem to be " + size + cause +
                     "; too uncertain to be taken off, and sigmas do not hold it";
  } else {
    check.sentence = "a shift of GNSS along the way of drive " + std::to_string(drive.drive) +
                     " cannot be told from an offset of all its positions (sigma " +
                     Fixed(shift.sigma, unit) + "): sigmas do not hold it";
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

// Clock and lever arm of one drive.
void FindAlongTheWay(const GnssDrive& drive,
                     const Sim3& enu_from_world,
                     DriveErrors& errors,
                     std::vector<CrossCheck>& checks) {
  if (drive.fixes.size() < kMinFixes) return;
  Regression regression(drive, enu_from_world);
  const std::vector<int> plain = {kEast, kNorth, kTurn, kStretch};
  std::vector<int> all = plain;
  all.insert(all.end(), {kAhead, kLeft});
  const Eigen::VectorXd found = regression.Solve(all);
  const Eigen::VectorXd sigmas = regression.Sigmas(found);
  const Shift shift{found[kAhead], sigmas[kAhead], regression.speed()};
  const bool is_beside = std::abs(found[kLeft]) > kBelievedSigmas * sigmas[kLeft];
  if (shift.IsBelieved() || is_beside) {
    std::vector<int> believed = plain;
    if (shift.IsBelieved()) believed.push_back(kAhead);
    if (is_beside) believed.push_back(kLeft);
    const Eigen::VectorXd alone = regression.Solve(believed);
    errors.ahead = alone[kAhead];
    errors.left_m = alone[kLeft];
    errors.ahead_sigma = shift.IsBelieved() ? sigmas[kAhead] : 0.0;
    errors.left_sigma_m = is_beside ? sigmas[kLeft] : 0.0;
  }
  if (shift.IsBelieved() || shift.IsDoubted() || shift.IsUnknown())
    checks.push_back(ClockCheck(drive, shift, shift.IsBelieved() ? errors.ahead : shift.ahead));
  if (is_beside) checks.push_back(LeverCheck(drive, errors.left_m, sigmas[kLeft]));
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

Eigen::Vector3d ErrorAt(const DriveErrors& errors,
                        const DrivenFix& fix,
                        const Sim3& enu_from_world) {
  const Eigen::Vector3d travel = TravelInEnu(fix, errors.has_times, enu_from_world);
  Eigen::Vector3d error = errors.offset_m + errors.ahead * travel;
  error.head<2>() += errors.left_m * LeftOf(travel);
  return error;
}

std::vector<Eigen::Matrix3d> CovariancesOfErrors(std::span<const DriveErrors> errors,
                                                 std::span<const GnssDrive> drives,
                                                 std::span<const Eigen::Vector3d> at) {
  std::vector<Eigen::Matrix3d> covariances(at.size(), Eigen::Matrix3d::Zero());
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (const GnssDrive& drive : drives) {
    for (const DrivenFix& fix : drive.fixes) middle += fix.centre_in_world.head<2>();
    count += static_cast<double>(drive.fixes.size());
  }
  if (count > 0.0) middle /= count;
  using FrameRow = Eigen::Matrix<double, 2, 4>;
  const auto row_at = [&](const Eigen::Vector3d& centre) {
    const Eigen::Vector2d from_middle = centre.head<2>() - middle;
    FrameRow row;
    row << 1.0, 0.0, -from_middle.y(), from_middle.x(), 0.0, 1.0, from_middle.x(), from_middle.y();
    return row;
  };
  for (const DriveErrors& of_drive : errors) {
    DriveErrors ahead{.has_times = of_drive.has_times, .ahead = of_drive.ahead_sigma};
    DriveErrors left{.has_times = of_drive.has_times, .left_m = of_drive.left_sigma_m};
    for (const DriveErrors& one_sigma : {ahead, left}) {
      Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
      Eigen::Vector4d b = Eigen::Vector4d::Zero();
      for (const GnssDrive& drive : drives) {
        for (const DrivenFix& fix : drive.fixes) {
          const FrameRow row = row_at(fix.centre_in_world);
          A += row.transpose() * row;
          if (drive.drive == of_drive.drive)
            b += row.transpose() * ErrorAt(one_sigma, fix, Sim3{}).head<2>();
        }
      }
      const Eigen::Vector4d shift = A.ldlt().solve(b);
      for (size_t i = 0; i < at.size(); ++i) {
        const Eigen::Vector2d moved = row_at(at[i]) * shift;
        covariances[i].topLeftCorner<2, 2>() += moved * moved.transpose();
      }
    }
  }
  return covariances;
}

FoundDriveErrors FindDriveErrors(std::span<const GnssDrive> drives, const Sim3& enu_from_world) {
  FoundDriveErrors found;
  std::vector<DriveErrors> errors;
  for (const GnssDrive& drive : drives) {
    DriveErrors& of_drive =
        errors.emplace_back(DriveErrors{.drive = drive.drive, .has_times = drive.has_times});
    FindAlongTheWay(drive, enu_from_world, of_drive, found.checks);
  }
  FindDatum(drives, enu_from_world, errors, found.checks);
  for (const DriveErrors& of_drive : errors) {
    if (of_drive.ahead != 0.0 || of_drive.left_m != 0.0 || !of_drive.offset_m.isZero())
      found.drives.push_back(of_drive);
  }
  return found;
}

}  // namespace orbweave
