// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace orbweave {

/// What a map shows beside registered images, which are dots. Each has a shape of its own, so that
/// colour is never all that tells it apart.
enum class MapSymbol {
  kOverlap,
  kLoose,
  kMissing,
  kContradicted,
  kSeamGood,
  kSeamUnknown,
  kSeamDoubtful,
  kSeamBad,
  kSeamUnused,
  kEllipse
};

/// Classes of the stylesheet, also what a legend looks for in a drawn map.
[[nodiscard]] std::string SymbolClass(MapSymbol symbol);

/// The symbol about `place` as SVG; `extra` are more classes, `title` is escaped text. For shapes
/// that are paths: neither kOverlap nor kEllipse.
[[nodiscard]] std::string DrawnSymbol(MapSymbol symbol,
                                      const Eigen::Vector2d& place,
                                      double radius,
                                      const std::string& extra,
                                      const std::string& title);

/// Entries of a legend, as HTML, for the symbols that `map` shows.
[[nodiscard]] std::string LegendOfSymbols(const std::string& map);

}  // namespace orbweave
