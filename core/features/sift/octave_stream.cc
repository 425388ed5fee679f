// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/octave_stream.h"

#include <algorithm>
#include <utility>

#include "core/base/status.h"
#include "core/features/sift/refine_extremum.h"

namespace orbweave::internal {
namespace {

/// Rows of a step that only the next step reads: those that came together, what is looked at around
/// them, and those beyond a pole.
int RowsToBlur() { return kRowsAtOnce + 2 * kMaxBlurRadius + kRowsBeyondPole; }

/// Rows of a level in use at a time, where `reach` rows are looked at to both sides of a keypoint
/// once the last level is there: these, and the way through all levels, which fine ones are ahead
/// in the middle of the panorama and coarse ones catch up with at its end. No more, as all windows
/// together should stay in the cache.
int RowsToUse(const ScaleSpacePlan& plan, int last_level, int reach) {
  int rows = kRowsAtOnce + 2 * (reach + 1) + kRowsBeyondPole + plan.base_taps.radius;
  for (int l = 0; l < last_level; ++l) rows += plan.taps[static_cast<size_t>(l)].radius;
  return std::max(rows, RowsToBlur());
}

int NextWidth(const ScaleSpacePlan& plan, uint32_t number) {
  return number + 1 < plan.octaves.size() ? plan.octaves[number + 1].width
                                          : plan.octaves[number].width / 2;
}
int NextHeight(const ScaleSpacePlan& plan, uint32_t number) {
  return number + 1 < plan.octaves.size() ? plan.octaves[number + 1].height
                                          : plan.octaves[number].height / 2;
}

}  // namespace

OctaveStream::OctaveStream(const ScaleSpacePlan& plan,
                           uint32_t number,
                           StreamPurpose purpose,
                           const SiftThresholds& thresholds,
                           const SiftKernels& kernels,
                           OctaveStream* next,
                           std::function<void(const OctaveStream&)> after_rows)
    : plan_(plan.octaves[number]),
      number_(number),
      purpose_(purpose),
      thresholds_(thresholds),
      kernels_(kernels),
      next_(next),
      after_rows_(std::move(after_rows)),
      row_halver_(plan_.height, NextHeight(plan, number)),
      column_halver_(plan_.width, NextWidth(plan, number)) {
  const auto add = [&](const RowRange& rows, const GaussianTaps& taps, int num_rows) {
    steps_.push_back({.rows = rows,
                      .ring = RowRing(plan_.width, plan_.height, num_rows),
                      .taps = taps,
                      .next = rows.begin});
  };
  const bool detects = purpose == StreamPurpose::kDetect;
  if (number == 0) add(plan.base, {}, RowsToBlur());
  level_0_ = steps_.size();
  const int last_level = detects ? kSiftLevels - 1 : kSiftScales;
  const int window = RowsToUse(plan, last_level, detects ? kRefinementReach : kPatchRadius);
  add(plan_.levels[0], plan.base_taps, detects ? window : RowsToBlur());
  for (int l = 1; l <= last_level; ++l)
    add(plan_.levels[static_cast<size_t>(l)], plan.taps[static_cast<size_t>(l) - 1], window);
  waiting_from_ = steps_.front().next;
  next_to_halve_ = next != nullptr ? plan.octaves[number + 1].levels[0].begin : 0;
  next_to_search_ = plan_.detection.begin;
  if (purpose == StreamPurpose::kDetect)
    hits_.resize(size_t{kSiftScales} * kExtremaColumns * kExtremaRows);
}

void OctaveStream::FinishRow(Step& step) {
  step.ring.Finish(step.next);
  ++step.next;
}

void OctaveStream::Advance() {
  const Step& input = steps_.front();
  if (input.next < input.rows.end && input.next - waiting_from_ < kRowsAtOnce) return;
  waiting_from_ = input.next;
  for (size_t i = 1; i < steps_.size(); ++i) {
    Blur(steps_[i - 1], steps_[i]);
    if (&steps_[i] == &LevelStep(kSiftScales) && next_ != nullptr) FeedNext();
  }
  if (purpose_ == StreamPurpose::kDetect) FindExtrema();
  if (after_rows_) after_rows_(*this);
}

void OctaveStream::Blur(const Step& from, Step& to) {
  const int radius = to.taps.radius;
  const bool is_complete = from.next == from.rows.end;
  const int end = is_complete ? to.rows.end : std::min(to.rows.end, from.next - radius);
  while (to.next < end) {
    const int num_rows = std::min(kRowsAtOnce, end - to.next);
    ORBWEAVE_CHECK(from.ring.Holds(to.next - radius, to.next + num_rows - 1 + radius));
    std::array<const float*, kRowsAtOnce + 2 * kMaxBlurRadius> rows{};
    std::array<float*, kRowsAtOnce> out{};
    for (int i = 0; i < num_rows + 2 * radius; ++i)
      rows[static_cast<size_t>(i)] = from.ring.Row(to.next - radius + i);
    for (int i = 0; i < num_rows; ++i) out[static_cast<size_t>(i)] = to.ring.Row(to.next + i);
    kernels_.blur({.rows = rows.data(),
                   .out = out.data(),
                   .num_rows = num_rows,
                   .columns = plan_.width,
                   .taps = to.taps.taps.data(),
                   .radius = radius});
    for (int i = 0; i < num_rows; ++i) FinishRow(to);
  }
}

void OctaveStream::FeedNext() {
  const Step& from = LevelStep(kSiftScales);
  const int end = next_->steps_.front().rows.end;
  const bool is_complete = from.next == from.rows.end;
  for (; next_to_halve_ < end; ++next_to_halve_) {
    const int first = row_halver_.FirstSource(next_to_halve_);
    if (!is_complete && first + kHalvingTaps > from.next) break;
    ORBWEAVE_CHECK(from.ring.Holds(first, first + kHalvingTaps - 1));
    std::array<const float*, kHalvingTaps> rows{};
    for (int i = 0; i < kHalvingTaps; ++i) rows[static_cast<size_t>(i)] = from.ring.Row(first + i);
    column_halver_.Halve(rows, row_halver_.Weights(next_to_halve_), next_->InputRow());
    next_->FinishInputRow();
    next_->Advance();
  }
}

void OctaveStream::FindExtrema() {
  const Step& last = LevelStep(kSiftLevels - 1);
  const bool is_complete = last.next == last.rows.end;
  const int end = is_complete ? plan_.detection.end
                              : std::min(plan_.detection.end, last.next - kRefinementReach);
  while (next_to_search_ < end) {
    const int num_rows = std::min(kExtremaRows, end - next_to_search_);
    FindInRows(next_to_search_, num_rows);
    next_to_search_ += num_rows;
  }
}

void OctaveStream::FindInRows(int first_row, int num_rows) {
  std::array<std::array<const float*, kExtremaRows + 2>, kSiftLevels> rows{};
  std::array<const RowRing*, kSiftLevels> rings{};
  ExtremaJob job{.num_rows = num_rows,
                 .threshold = static_cast<float>(0.5 * 255.0 / kSiftScales * thresholds_.contrast),
                 .hits = hits_.data()};
  for (size_t l = 0; l < kSiftLevels; ++l) {
    rings[l] = &LevelStep(static_cast<int>(l)).ring;
    ORBWEAVE_CHECK(
        rings[l]->Holds(first_row - kRefinementReach, first_row + num_rows - 1 + kRefinementReach));
    for (int i = 0; i < num_rows + 2; ++i)
      rows[l][static_cast<size_t>(i)] = rings[l]->Row(first_row - 1 + i);
    job.rows[l] = rows[l].data();
  }
  for (int column = 0; column < plan_.width; column += kExtremaColumns) {
    job.first_column = column;
    job.end_column = std::min(column + kExtremaColumns, plan_.width);
    const size_t count = kernels_.find_extrema(job);
    for (size_t i = 0; i < count; ++i) {
      SiftHit hit = hits_[i];
      hit.row += first_row;
      auto position = RefineExtremum(rings, hit, thresholds_);
      if (!position.has_value()) continue;
      position->octave = number_;
      positions_.push_back(*position);
    }
  }
}

}  // namespace orbweave::internal
