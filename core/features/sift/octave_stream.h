// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/features/sift/halve_rows.h"
#include "core/features/sift/octave_plan.h"
#include "core/features/sift/row_ring.h"
#include "core/features/sift/sift_position.h"
#include "core/features/sift_thresholds.h"

namespace orbweave::internal {

/// Rows that go through an octave together: source rows are then read once for many.
constexpr int kRowsAtOnce = 16;

/// What a pass over a panorama is for: to find extrema, or to describe keypoints on the levels
/// 1 ... kSiftScales.
enum class StreamPurpose { kDetect, kDescribe };

/// One octave of the scale space as a sliding window: rows of its grid come in, go through all
/// levels as far as their neighbours are there, give extrema and half as many rows for the next
/// octave, and are forgotten.
class OctaveStream {
 public:
  /// `next` is the next coarser octave, if there is one. `after_rows` is called whenever rows were
  /// taken through all levels.
  OctaveStream(const ScaleSpacePlan& plan,
               uint32_t number,
               StreamPurpose purpose,
               const SiftThresholds& thresholds,
               const SiftKernels& kernels,
               OctaveStream* next,
               std::function<void(const OctaveStream&)> after_rows);

  /// Where the next row of the input is to be written: of the plan's base in the first octave, of
  /// level 0 in others.
  [[nodiscard]] float* InputRow() { return steps_.front().ring.Row(steps_.front().next); }
  void FinishInputRow() { FinishRow(steps_.front()); }

  /// Takes the rows that came through all levels, and the octaves that follow, too. Waits for
  /// kRowsAtOnce rows, but for the last ones.
  void Advance();

  /// To describe: the latest rows of a level, kPatchRadius to both sides of the rows to come, and
  /// the row before which all these levels are there.
  [[nodiscard]] const RowRing& rows_of(int level) const { return LevelStep(level).ring; }
  [[nodiscard]] int described_until() const { return LevelStep(kSiftScales).next; }
  /// Number in the plan.
  [[nodiscard]] uint32_t number() const { return number_; }
  /// As found: row after row. Columns are within the grid, rows may lie beyond the poles.
  [[nodiscard]] const std::vector<SiftPosition>& positions() const { return positions_; }

 private:
  /// A level, or the base.
  struct Step {
    RowRange rows{};
    RowRing ring;
    GaussianTaps taps{};  ///< from the step before
    int next = 0;         ///< row that is computed next
  };

  [[nodiscard]] Step& LevelStep(int level) { return steps_[level_0_ + static_cast<size_t>(level)]; }
  [[nodiscard]] const Step& LevelStep(int level) const {
    return const_cast<OctaveStream*>(this)->LevelStep(level);
  }
  static void FinishRow(Step& step);
  void Blur(const Step& from, Step& to);
  void FeedNext();
  void FindExtrema();
  void FindInRows(int first_row, int num_rows);

  const OctavePlan& plan_;
  uint32_t number_ = 0;
  StreamPurpose purpose_ = StreamPurpose::kDetect;
  SiftThresholds thresholds_{};
  const SiftKernels& kernels_;
  OctaveStream* next_ = nullptr;
  std::function<void(const OctaveStream&)> after_rows_{};
  RowHalver row_halver_;
  ColumnHalver column_halver_;
  std::vector<Step> steps_{};
  size_t level_0_ = 0;    ///< its step
  int waiting_from_ = 0;  ///< row of the input
  int next_to_halve_ = 0;
  int next_to_search_ = 0;
  std::vector<SiftHit> hits_{};
  std::vector<SiftPosition> positions_{};
};

}  // namespace orbweave::internal
