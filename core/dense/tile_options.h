// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/options.h"

namespace orbweave {

/// How points are laid into tiles.
struct TileOptions {
  int max_points = 4000000;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("max_points",
          self.max_points,
          "a tile with more is cut into pieces, each with points of other panoramas",
          Range{1000, 1e9});
  }
};

}  // namespace orbweave
