// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/dense/match_kernel.h"
#include "core/geometry/cube_face.h"

namespace orbweave {

/// The plane that each pixel of a reference raster holds, q.x = 1 in the frame of its face, and its
/// cost; each face continued by kApron_px pixels. The pixels of a row are split by the colour they
/// have on a chessboard, so that those of one colour are neighbours in memory: place h of colour c
/// in row r is column 2 h + (r + c) mod 2. Rows and columns here count from the apron's corner.
class PlaneField {
 public:
  static constexpr int kApron_px = 10;

  explicit PlaneField(int face_px);

  [[nodiscard]] int FacePx() const { return face_px_; }
  /// Index of a place of a colour in a row.
  [[nodiscard]] size_t At(int face, int colour, int row, int place) const {
    return ((static_cast<size_t>(face) * 2 + static_cast<size_t>(colour)) *
                static_cast<size_t>(rows_) +
            static_cast<size_t>(row)) *
               static_cast<size_t>(places_) +
           static_cast<size_t>(place);
  }
  /// Index of a pixel.
  [[nodiscard]] size_t AtPixel(int face, int row, int column) const {
    return At(face, (row + column) & 1, row, column >> 1);
  }
  /// Copies what lies beyond the edges of faces from the faces that show it.
  void FillAprons();

  std::vector<float> x{}, y{}, z{}, cost{};
  std::vector<float> sigma{};  ///< of the inverse range, as a share of it; infinite where unknown

 private:
  struct Copy {
    uint32_t from;
    uint32_t to;
    uint8_t turn;  // 6 * face of `to` + face of `from`
  };

  int face_px_;
  int rows_;
  int places_;
  std::vector<Copy> copies_{};
  std::array<std::array<float, 9>, kCubeFaces * kCubeFaces> turns_{};
};

}  // namespace orbweave
