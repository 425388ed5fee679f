// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/adjustment_messages.h"

#include <algorithm>
#include <span>
#include <utility>

#include "proto/codec/pack.h"
#include "proto/codec/pack_matrices.h"
#include "proto/codec/plausible.h"
#include "proto/codec/reconstruction_messages.h"

namespace orbweave::codec {
namespace {

/// Every column ascends to its diagonal block.
bool IsUpperTriangle(const SymmetricBlockMatrix& S) {
  if (S.column_start.size() != size_t{S.num_blocks} + 1 || S.column_start.front() != 0 ||
      S.column_start.back() != S.rows.size())
    return false;
  for (uint32_t j = 0; j < S.num_blocks; ++j) {
    const uint32_t begin = S.column_start[j];
    const uint32_t end = S.column_start[j + 1];
    if (begin >= end || end > S.rows.size() || S.rows[end - 1] != j) return false;
    for (uint32_t p = begin + 1; p < end; ++p) {
      if (S.rows[p - 1] >= S.rows[p]) return false;
    }
  }
  return true;
}

/// The sigma of a bias that another subproblem counts is infinite; that of one that there shall not
/// be is zero.
absl::Status CheckBiases(const std::vector<SubproblemBias>& biases) {
  const auto is_bias = [](const SubproblemBias& bias) {
    return bias.sigma_m >= 0.0 && IsPlace(bias.value_m);
  };
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(Ascends(biases, &SubproblemBias::group), "biases", "drives are not in order"));
  return Expect(std::ranges::all_of(biases, is_bias), "biases", "a sigma or a value is none");
}

absl::Status CheckNumbers(const NormalSystem& system) {
  const auto are_numbers = [](const auto& matrix) { return AreNumbers(matrix); };
  return Expect(std::ranges::all_of(system.S.values, are_numbers) &&
                    std::ranges::all_of(system.rhs, are_numbers) &&
                    std::ranges::all_of(system.gradient, are_numbers) &&
                    std::ranges::all_of(system.trace, are_numbers),
                "separator system",
                "no numbers");
}

absl::Status CheckPattern(const ResidualPattern& pattern) {
  return Expect(std::ranges::all_of(pattern.sum_px, IsNumber) &&
                    std::ranges::all_of(pattern.sum_up_px, IsNumber) &&
                    std::ranges::all_of(pattern.band_up_px, IsNumber),
                "pattern",
                "no numbers");
}

/// No number at all is a step that led nowhere, which nobody takes; a cost below zero would be one
/// that everybody takes.
absl::Status CheckTrial(const TrialCost& trial) {
  const auto is_negative = [](const RetainedPointTrial& point) {
    return point.cost_before < 0.0 ||
           std::ranges::any_of(point.after, [](const PointCost& cost) { return cost.cost < 0.0; });
  };
  return Expect(!(trial.cost < 0.0) && std::ranges::none_of(trial.retained_points, is_negative),
                "trial",
                "a cost below zero");
}

}  // namespace

void ToProto(const std::vector<SubproblemBias>& biases, v1::Biases* proto) {
  std::vector<uint32_t> groups;
  std::vector<uint8_t> is_separator;
  std::vector<double> sigmas_m;
  std::vector<Eigen::Vector3d> values_m;
  for (const SubproblemBias& bias : biases) {
    groups.push_back(bias.group);
    is_separator.push_back(bias.is_separator ? 1 : 0);
    sigmas_m.push_back(bias.sigma_m);
    values_m.push_back(bias.value_m);
  }
  proto->set_groups(Pack(groups));
  proto->set_is_separator(Pack(is_separator));
  proto->set_sigmas_m(Pack(sigmas_m));
  proto->set_values_m(PackVectors(values_m));
}

absl::StatusOr<std::vector<SubproblemBias>> FromProto(const v1::Biases& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto groups, Unpack<uint32_t>(proto.groups(), "biases"));
  const size_t count = groups.size();
  ORBWEAVE_ASSIGN_OR_RETURN(const auto is_separator,
                            UnpackExactly<uint8_t>(proto.is_separator(), count, "bias flags"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto sigmas_m,
                            UnpackExactly<double>(proto.sigmas_m(), count, "bias sigmas"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto values_m,
                            UnpackExactly<Vector3Bytes>(proto.values_m(), count, "bias values"));
  std::vector<SubproblemBias> biases;
  for (size_t i = 0; i < count; ++i) {
    biases.push_back({.group = groups[i],
                      .is_separator = is_separator[i] != 0,
                      .sigma_m = sigmas_m[i],
                      .value_m = ToVector(values_m[i])});
  }
  ORBWEAVE_RETURN_IF_ERROR(Expect(AreFlags(is_separator, 1), "biases", "unknown flags"));
  ORBWEAVE_RETURN_IF_ERROR(CheckBiases(biases));
  return biases;
}

void ToProto(const std::vector<SeparatorId>& ids, v1::SeparatorIds* proto) {
  std::vector<uint8_t> kinds;
  std::vector<uint32_t> indices;
  for (const SeparatorId& id : ids) {
    kinds.push_back(static_cast<uint8_t>(id.kind));
    indices.push_back(id.index);
  }
  proto->set_kinds(Pack(kinds));
  proto->set_indices(Pack(indices));
}

absl::StatusOr<std::vector<SeparatorId>> FromProto(const v1::SeparatorIds& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto indices, Unpack<uint32_t>(proto.indices(), "separators"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto kinds, UnpackExactly<uint8_t>(proto.kinds(), indices.size(), "separator kinds"));
  std::vector<SeparatorId> ids;
  for (size_t i = 0; i < indices.size(); ++i) {
    if (kinds[i] > static_cast<uint8_t>(SeparatorId::Kind::kPoint))
      return absl::DataLossError("separators: an unknown kind");
    ids.push_back({static_cast<SeparatorId::Kind>(kinds[i]), indices[i]});
  }
  ORBWEAVE_RETURN_IF_ERROR(Expect(Ascends(ids), "separators", "not in order"));
  return ids;
}

void ToProto(const SeparatorSystem& system, v1::SeparatorSystem* proto) {
  ToProto(system.variables, proto->mutable_variables());
  proto->set_is_definite(system.is_definite);
  const NormalSystem& normal = system.normal;
  proto->set_column_start(Pack(normal.S.column_start));
  proto->set_rows(Pack(normal.S.rows));
  proto->set_values(PackMatrices(normal.S.values));
  proto->set_rhs(PackMatrices(normal.rhs));
  proto->set_gradient(PackMatrices(normal.gradient));
  proto->set_trace(PackMatrices(normal.trace));
}

absl::StatusOr<SeparatorSystem> FromProto(const v1::SeparatorSystem& proto) {
  SeparatorSystem system{.is_definite = proto.is_definite()};
  ORBWEAVE_ASSIGN_OR_RETURN(system.variables, FromProto(proto.variables()));
  if (!system.is_definite) return system;
  const size_t count = system.variables.size();
  SymmetricBlockMatrix S{.num_blocks = static_cast<uint32_t>(count)};
  ORBWEAVE_ASSIGN_OR_RETURN(S.column_start, Unpack<uint32_t>(proto.column_start(), "columns"));
  if (count == 0) S.column_start.assign(1, 0);
  ORBWEAVE_ASSIGN_OR_RETURN(S.rows, Unpack<uint32_t>(proto.rows(), "rows"));
  if (!IsUpperTriangle(S)) return absl::DataLossError("separator system: not an upper triangle");
  ORBWEAVE_ASSIGN_OR_RETURN(S.values,
                            UnpackMatrices<Block6>(proto.values(), S.rows.size(), "values"));
  system.normal = MakeNormalSystem(std::move(S));
  ORBWEAVE_ASSIGN_OR_RETURN(system.normal.rhs, UnpackMatrices<Vector6>(proto.rhs(), count, "rhs"));
  ORBWEAVE_ASSIGN_OR_RETURN(system.normal.gradient,
                            UnpackMatrices<Vector6>(proto.gradient(), count, "gradient"));
  ORBWEAVE_ASSIGN_OR_RETURN(system.normal.trace,
                            UnpackMatrices<Eigen::Vector2d>(proto.trace(), count, "trace"));
  ORBWEAVE_RETURN_IF_ERROR(CheckNumbers(system.normal));
  return system;
}

void ToProto(const std::vector<ShortenedPoint>& points, v1::ShortenedPoints* proto) {
  std::vector<uint32_t> ids;
  std::vector<double> shares;
  for (const ShortenedPoint& point : points) {
    ids.push_back(point.point);
    shares.push_back(point.share);
  }
  proto->set_points(Pack(ids));
  proto->set_shares(Pack(shares));
}

absl::StatusOr<std::vector<ShortenedPoint>> FromProto(const v1::ShortenedPoints& proto) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto ids, Unpack<uint32_t>(proto.points(), "shortened points"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto shares,
                            UnpackExactly<double>(proto.shares(), ids.size(), "shares"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(Ascends(ids), "shortened points", "not in order"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(std::ranges::all_of(shares, IsShare), "shortened points", "a share is none"));
  std::vector<ShortenedPoint> points;
  for (size_t i = 0; i < ids.size(); ++i) points.push_back({ids[i], shares[i]});
  return points;
}

void ToProto(const SubproblemSummary& summary, v1::SubproblemSummary* proto) {
  ToProto(Reconstruction{.images = summary.owned_images}, proto->mutable_owned());
  std::vector<ImageId> images;
  std::vector<uint32_t> counts;
  for (const auto& [id, count] : summary.observations_of_image) {
    images.push_back(id);
    counts.push_back(count);
  }
  proto->set_observed_images(Pack(images));
  proto->set_observation_counts(Pack(counts));
  ToProto(summary.biases, proto->mutable_biases());
  proto->set_residual_px_sum(summary.residual_px_sum);
  proto->set_residual_px2_sum(summary.residual_px2_sum);
  proto->set_cluster(summary.cluster);
  proto->set_pattern_sums_px(Pack(std::span<const double>(summary.pattern.sum_px)));
  proto->set_pattern_counts(Pack(std::span<const uint32_t>(summary.pattern.count)));
  proto->set_pattern_up_sums_px(Pack(std::span<const double>(summary.pattern.sum_up_px)));
  proto->set_pattern_band_up_sums_px(Pack(std::span<const double>(summary.pattern.band_up_px)));
  proto->set_pattern_band_counts(Pack(std::span<const uint32_t>(summary.pattern.band_count)));
}

absl::StatusOr<SubproblemSummary> FromProto(const v1::SubproblemSummary& proto) {
  SubproblemSummary summary{.cluster = proto.cluster(),
                            .residual_px_sum = proto.residual_px_sum(),
                            .residual_px2_sum = proto.residual_px2_sum()};
  ORBWEAVE_ASSIGN_OR_RETURN(Reconstruction owned, FromProto(proto.owned()));
  summary.owned_images = std::move(owned.images);
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images, Unpack<ImageId>(proto.observed_images(), "images"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto counts,
      UnpackExactly<uint32_t>(proto.observation_counts(), images.size(), "counts"));
  ORBWEAVE_RETURN_IF_ERROR(Expect(Ascends(images), "block summary", "images are not in order"));
  ORBWEAVE_RETURN_IF_ERROR(
      Expect(IsAmount(summary.residual_px_sum) && IsAmount(summary.residual_px2_sum),
             "block summary",
             "a residual is none"));
  for (size_t i = 0; i < images.size(); ++i) summary.observations_of_image[images[i]] = counts[i];
  ORBWEAVE_ASSIGN_OR_RETURN(summary.biases, FromProto(proto.biases()));
  if (proto.pattern_counts().empty()) return summary;
  constexpr size_t kSectors = ResidualPattern::kSectors;
  ORBWEAVE_ASSIGN_OR_RETURN(const auto sums,
                            UnpackExactly<double>(proto.pattern_sums_px(), kSectors, "pattern"));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto sector_counts,
                            UnpackExactly<uint32_t>(proto.pattern_counts(), kSectors, "pattern"));
  std::ranges::copy(sums, summary.pattern.sum_px.begin());
  std::ranges::copy(sector_counts, summary.pattern.count.begin());
  constexpr size_t kBands = ResidualPattern::kBands;
  ORBWEAVE_ASSIGN_OR_RETURN(const auto ups,
                            UnpackExactly<double>(proto.pattern_up_sums_px(), kSectors, "pattern"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto band_ups,
      UnpackExactly<double>(proto.pattern_band_up_sums_px(), kBands, "pattern"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto band_counts,
      UnpackExactly<uint32_t>(proto.pattern_band_counts(), kBands, "pattern"));
  std::ranges::copy(ups, summary.pattern.sum_up_px.begin());
  std::ranges::copy(band_ups, summary.pattern.band_up_px.begin());
  std::ranges::copy(band_counts, summary.pattern.band_count.begin());
  ORBWEAVE_RETURN_IF_ERROR(CheckPattern(summary.pattern));
  return summary;
}

void ToProto(const CrossCheck& check, v1::CrossCheck* proto) {
  proto->set_name(check.name);
  proto->set_value(check.value);
  proto->set_limit(check.limit);
  proto->set_unit(check.unit);
  proto->set_level(static_cast<uint32_t>(check.level));
  proto->set_sentence(check.sentence);
  proto->set_at_least(check.bound == CheckBound::kAtLeast);
  proto->set_is_untold(!check.is_told);
}

absl::StatusOr<CrossCheck> FromProto(const v1::CrossCheck& proto) {
  if (proto.level() > static_cast<uint32_t>(CheckLevel::kBad) || !IsNumber(proto.value()) ||
      !IsNumber(proto.limit())) {
    return absl::DataLossError("cross check: unknown level, or not a number");
  }
  return CrossCheck{.name = proto.name(),
                    .value = proto.value(),
                    .limit = proto.limit(),
                    .unit = proto.unit(),
                    .level = static_cast<CheckLevel>(proto.level()),
                    .sentence = proto.sentence(),
                    .bound = proto.at_least() ? CheckBound::kAtLeast : CheckBound::kAtMost,
                    .is_told = !proto.is_untold()};
}

void ToProto(const TrialCost& trial, v1::TrialCost* proto) {
  proto->set_cost(trial.cost);
  proto->set_predicted_decrease(trial.predicted_decrease);
  std::vector<double> before;
  std::vector<double> after;
  std::vector<uint8_t> behind;
  for (const RetainedPointTrial& point : trial.retained_points) {
    before.push_back(point.cost_before);
    for (const PointCost& cost : point.after) {
      after.push_back(cost.cost);
      behind.push_back(cost.any_behind ? 1 : 0);
    }
  }
  proto->set_retained_before(Pack(before));
  proto->set_retained_after(Pack(after));
  proto->set_retained_behind(Pack(behind));
}

absl::StatusOr<TrialCost> FromProto(const v1::TrialCost& proto) {
  TrialCost trial{.cost = proto.cost(), .predicted_decrease = proto.predicted_decrease()};
  ORBWEAVE_ASSIGN_OR_RETURN(const auto before,
                            Unpack<double>(proto.retained_before(), "kept points"));
  const size_t shares = kStepShares.size();
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto after,
      UnpackExactly<double>(proto.retained_after(), shares * before.size(), "kept points' costs"));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const auto behind,
      UnpackExactly<uint8_t>(
          proto.retained_behind(), shares * before.size(), "kept points' flags"));
  for (size_t i = 0; i < before.size(); ++i) {
    RetainedPointTrial& point = trial.retained_points.emplace_back();
    point.cost_before = before[i];
    for (size_t k = 0; k < shares; ++k)
      point.after[k] = {after[shares * i + k], behind[shares * i + k] != 0};
  }
  ORBWEAVE_RETURN_IF_ERROR(Expect(AreFlags(behind, 1), "trial", "unknown flags"));
  ORBWEAVE_RETURN_IF_ERROR(CheckTrial(trial));
  return trial;
}

}  // namespace orbweave::codec
