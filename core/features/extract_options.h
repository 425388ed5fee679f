// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

enum class SiftDetector { kStreaming, kOpencv };

template <>
struct EnumNames<SiftDetector> {
  static constexpr std::array<std::pair<SiftDetector, std::string_view>, 2> kNames = {
      {{SiftDetector::kStreaming, "streaming"}, {SiftDetector::kOpencv, "opencv"}}};
};

enum class FirstOctave { kAuto, kDoubled, kFull };

template <>
struct EnumNames<FirstOctave> {
  static constexpr std::array<std::pair<FirstOctave, std::string_view>, 3> kNames = {
      {{FirstOctave::kAuto, "auto"},
       {FirstOctave::kDoubled, "doubled"},
       {FirstOctave::kFull, "full"}}};
};

enum class UseFacades { kAuto, kOn, kOff };

template <>
struct EnumNames<UseFacades> {
  static constexpr std::array<std::pair<UseFacades, std::string_view>, 3> kNames = {
      {{UseFacades::kAuto, "auto"}, {UseFacades::kOn, "on"}, {UseFacades::kOff, "off"}}};
};

struct ExtractOptions {
  SiftDetector detector = SiftDetector::kStreaming;
  FirstOctave first_octave = FirstOctave::kAuto;
  int max_features = 10000;
  UseFacades facades = UseFacades::kAuto;
  int facade_features = 2500;
  double max_latitude_deg = 65.0;
  double contrast_threshold = 0.003;
  double edge_threshold = 10.0;
  int tile_size_px = 1024;
  int max_image_width_px = 32768;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("detector", self.detector, "our own SIFT, or OpenCV's in tiles: five times slower");
    visit("first_octave",
          self.first_octave,
          "finest scales: of the doubled panorama, of the panorama, or by its width (streaming)");
    visit("max_features",
          self.max_features,
          "keypoints kept per panorama, spread over the sphere",
          Range{64, 65536});
    visit(
        "facades",
        self.facades,
        "features of views that show walls in their true shape, too, for panoramas far apart; "
        "auto: where GNSS has most further than 4 m from all but one other, or most see fewer than "
        "three others beyond doubt without");
    visit("facade_features",
          self.facade_features,
          "keypoints kept of each of the eight such views",
          Range{64, 8192});
    visit("max_latitude_deg",
          self.max_latitude_deg,
          "keypoints further from the horizon are not used",
          Range{5, 90});
    visit("contrast_threshold",
          self.contrast_threshold,
          "weakest SIFT contrast; the best max_features above it are kept",
          Range{0.001, 0.2});
    visit("edge_threshold", self.edge_threshold, "SIFT edge threshold", Range{2, 50});
    visit("tile_size_px",
          self.tile_size_px,
          "rows and columns worked on at a time, bounds the memory (opencv)",
          Range{64, 16384});
    visit("max_image_width_px",
          self.max_image_width_px,
          "wider images are refused before decoding",
          Range{64, 65536});
  }
};

}  // namespace orbweave
