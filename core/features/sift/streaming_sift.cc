// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/streaming_sift.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/features/row_across_poles.h"
#include "core/features/sift/grey_rows.h"

namespace orbweave {
namespace {

using internal::DescribedPosition;
using internal::kPatchRadius;
using internal::kRowsAtOnce;
using internal::OctavePlan;
using internal::OctaveStream;
using internal::ScaleSpacePlan;
using internal::SiftPosition;
using internal::StreamPurpose;

/// Brings a position that was refined beyond a pole or across the seam back to the grid.
SiftPosition OnGrid(SiftPosition p, const ScaleSpacePlan& plan) {
  const OctavePlan& octave = plan.octaves[p.octave];
  const SourceRow source = RowAcrossPoles(p.row, octave.height);
  if (source.turned) {
    p.dy = -p.dy;
    p.column += octave.width / 2;
  }
  p.row = source.row;
  p.column = Modulo(p.column, octave.width);
  return p;
}

auto PixelOf(const SiftPosition& p) { return std::tie(p.octave, p.row, p.column, p.scale); }
auto AllOf(const SiftPosition& p) {
  return std::tuple_cat(PixelOf(p), std::tie(p.dy, p.dx, p.dscale, p.response));
}

/// Extrema that ended in the same pixel are one.
void Unite(std::vector<SiftPosition>& positions) {
  std::sort(positions.begin(), positions.end(), [](const auto& a, const auto& b) {
    return AllOf(a) < AllOf(b);
  });
  const auto is_same = [](const auto& a, const auto& b) { return PixelOf(a) == PixelOf(b); };
  positions.erase(std::unique(positions.begin(), positions.end(), is_same), positions.end());
}

/// Describes the positions of one octave, which are sorted by row, as their rows come.
class OctaveDescriber {
 public:
  OctaveDescriber(const ScaleSpacePlan& plan, size_t octave, const internal::SiftKernels& kernels)
      : plan_(plan), height_(plan.octaves[octave].height), describer_(kernels) {}

  void Add(uint32_t position) { queue_.push_back(position); }
  [[nodiscard]] bool IsDone() const { return next_ == queue_.size(); }

  void Advance(const OctaveStream& octave,
               const std::vector<SiftPosition>& positions,
               std::vector<DescribedPosition>& described) {
    for (; next_ < queue_.size(); ++next_) {
      const SiftPosition& position = positions[queue_[next_]];
      const int last_row = std::min(position.row + kPatchRadius, height_ - 1);
      if (last_row >= octave.described_until()) return;
      const double sigma = SigmaOfLevel(plan_, position.scale + double{position.dscale});
      describer_.Describe(position,
                          static_cast<float>(sigma),
                          queue_[next_],
                          octave.rows_of(position.scale),
                          described);
    }
  }

 private:
  const ScaleSpacePlan& plan_;
  int height_ = 0;
  internal::PositionDescriber describer_;
  std::vector<uint32_t> queue_{};
  size_t next_ = 0;
};

}  // namespace

StreamingSift::StreamingSift(const cv::Mat& panorama, const StreamingSiftOptions& options)
    : panorama_(panorama),
      options_(options),
      plan_(internal::PlanScaleSpace(
          panorama.cols, panorama.rows, options.doubled, options.first_y, options.end_y)) {}

StreamingSift::Octaves StreamingSift::MakeOctaves(
    StreamPurpose purpose, const std::function<void(const OctaveStream&)>& after_rows) const {
  Octaves octaves(plan_.octaves.size());
  OctaveStream* next = nullptr;
  for (auto i = static_cast<uint32_t>(octaves.size()); i-- > 0;) {
    octaves[i] = std::make_unique<OctaveStream>(
        plan_, i, purpose, options_.thresholds, SiftKernelsOf(options_.kernel), next, after_rows);
    next = octaves[i].get();
  }
  return octaves;
}

absl::Status StreamingSift::Stream(const Octaves& octaves, const StageContext& context) const {
  if (octaves.empty()) return absl::OkStatus();
  internal::GreyRows greys(panorama_, options_.doubled);
  OctaveStream& first = *octaves.front();
  for (int y = plan_.base.begin; y < plan_.base.end; ++y) {
    greys.Write(y, first.InputRow());
    first.FinishInputRow();
    if ((y + 1 - plan_.base.begin) % kRowsAtOnce != 0 && y + 1 < plan_.base.end) continue;
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    first.Advance();
  }
  return absl::OkStatus();
}

absl::Status StreamingSift::Detect(const StageContext& context) {
  Octaves octaves = MakeOctaves(StreamPurpose::kDetect, {});
  ORBWEAVE_RETURN_IF_ERROR(Stream(octaves, context));
  for (const auto& octave : octaves) {
    for (const SiftPosition& position : octave->positions())
      positions_.push_back(OnGrid(position, plan_));
  }
  Unite(positions_);
  return absl::OkStatus();
}

Keypoint StreamingSift::KeypointOf(size_t position) const {
  const SiftPosition& p = positions_[position];
  const OctavePlan& octave = plan_.octaves[p.octave];
  double x = (p.column + double{p.dx} + 0.5) * octave.panorama_from_x;
  double y = (p.row + double{p.dy} + 0.5) * octave.panorama_from_y;
  if (y < 0.0 || y > plan_.height) {
    y = y < 0.0 ? -y : 2.0 * plan_.height - y;
    x += 0.5 * plan_.width;
  }
  auto x_px = static_cast<float>(x - plan_.width * std::floor(x / plan_.width));
  if (x_px >= static_cast<float>(plan_.width)) x_px = 0.0F;  // rounding may reach the seam
  const double scale = internal::SigmaOfLevel(plan_, p.scale + double{p.dscale}) *
                       std::sqrt(octave.panorama_from_x * octave.panorama_from_y);
  return {.x_px = x_px, .y_px = static_cast<float>(y), .scale_px = static_cast<float>(scale)};
}

absl::StatusOr<std::vector<DescribedPosition>> StreamingSift::Describe(
    std::span<const uint32_t> chosen, const StageContext& context) {
  std::vector<OctaveDescriber> describers;
  for (size_t o = 0; o < plan_.octaves.size(); ++o)
    describers.emplace_back(plan_, o, SiftKernelsOf(options_.kernel));
  std::vector<uint32_t> sorted(chosen.begin(), chosen.end());
  std::sort(sorted.begin(), sorted.end());  // as positions are: by octave and row
  for (const uint32_t i : sorted) describers[positions_[i].octave].Add(i);

  std::vector<DescribedPosition> described;
  const Octaves octaves = MakeOctaves(StreamPurpose::kDescribe, [&](const OctaveStream& octave) {
    describers[octave.number()].Advance(octave, positions_, described);
  });
  ORBWEAVE_RETURN_IF_ERROR(Stream(octaves, context));
  for (const OctaveDescriber& describer : describers) ORBWEAVE_CHECK(describer.IsDone());
  return described;
}

}  // namespace orbweave
