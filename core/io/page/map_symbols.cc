// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/map_symbols.h"

#include "absl/strings/str_cat.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

struct SymbolStyle {
  MapSymbol symbol;
  const char* classes;
  const char* text;
};

constexpr SymbolStyle kStyles[] = {
    {MapSymbol::kOverlap, "dot overlap", "in two clusters or more"},
    {MapSymbol::kLoose, "sym loose", "placed loosely, not registered"},
    {MapSymbol::kMissing, "sym missing", "not registered, at its GNSS position"},
    {MapSymbol::kContradicted, "sym outlier", "contradicted GNSS position"},
    {MapSymbol::kSeamGood, "sym seam fits", "seam that fits"},
    {MapSymbol::kSeamUnknown, "sym seam unknown", "seam without certificate"},
    {MapSymbol::kSeamDoubtful, "sym seam doubtful", "doubtful seam"},
    {MapSymbol::kSeamBad, "sym seam bad", "bad seam"},
    {MapSymbol::kSeamUnused, "sym seam unused", "seam that is switched off"},
    {MapSymbol::kEllipse, "sigma", "error ellipse, one sigma"}};

const SymbolStyle& StyleOf(MapSymbol symbol) {
  for (const SymbolStyle& style : kStyles) {
    if (style.symbol == symbol) return style;
  }
  return kStyles[0];
}

/// Outline about the origin.
std::string PathOf(MapSymbol symbol, double r) {
  const std::string one = DecimalText(r, 1);
  const std::string two = DecimalText(2.0 * r, 1);
  const std::string low = DecimalText(-r, 1);
  switch (symbol) {
    case MapSymbol::kLoose:
      return absl::StrCat("M", low, ",", low, "h", two, "v", two, "h-", two, "z");
    case MapSymbol::kMissing:
      return absl::StrCat("M", low, ",0h", two, "M0,", low, "v", two);
    case MapSymbol::kContradicted:
      return absl::StrCat("M", low, ",", low, "l", two, ",", two, "m0,-", two, "l-", two, ",", two);
    case MapSymbol::kSeamDoubtful:
      return absl::StrCat("M0,", low, "l", one, ",", two, "h-", two, "z");
    case MapSymbol::kSeamBad:
      return absl::StrCat("M", low, ",", low, "h", two, "l-", one, ",", two, "z");
    case MapSymbol::kSeamUnknown:
      return absl::StrCat(
                 "M0,", low, "l", one, ",", one, "l-", one, ",", one, "l-", one, ",-", one, "z") +
             absl::StrCat("M", low, ",0h", two);
    case MapSymbol::kSeamUnused:
      return absl::StrCat("M", low, ",", low, "h", two, "l-", two, ",", two, "h", two, "z");
    default:
      return absl::StrCat(
          "M0,", low, "l", one, ",", one, "l-", one, ",", one, "l-", one, ",-", one, "z");
  }
}

std::string LegendIcon(MapSymbol symbol) {
  const std::string classes = SymbolClass(symbol);
  if (symbol == MapSymbol::kOverlap)
    return absl::StrCat("<circle class=\"", classes, " kn\" r=\"5\"/>");
  if (symbol == MapSymbol::kEllipse)
    return absl::StrCat("<ellipse class=\"", classes, "\" rx=\"7.5\" ry=\"4.5\"/>");
  return absl::StrCat("<path class=\"", classes, "\" d=\"", PathOf(symbol, 5.0), "\"/>");
}

}  // namespace

std::string SymbolClass(MapSymbol symbol) { return StyleOf(symbol).classes; }

std::string DrawnSymbol(MapSymbol symbol,
                        const Eigen::Vector2d& place,
                        double radius,
                        const std::string& extra,
                        const std::string& title) {
  return absl::StrCat("<g transform=\"translate(",
                      DecimalText(place.x(), 1),
                      ",",
                      DecimalText(place.y(), 1),
                      ")\"><path class=\"",
                      SymbolClass(symbol),
                      extra.empty() ? "" : " " + extra,
                      "\" d=\"",
                      PathOf(symbol, radius),
                      "\"/><title>",
                      title,
                      "</title></g>");
}

std::string LegendOfSymbols(const std::string& map) {
  std::string entries;
  for (const SymbolStyle& style : kStyles) {
    if (map.find(absl::StrCat("class=\"", style.classes)) == std::string::npos) continue;
    absl::StrAppend(&entries,
                    "<span><svg class=\"icon\" viewBox=\"-8 -8 16 16\">",
                    LegendIcon(style.symbol),
                    "</svg>",
                    style.text,
                    "</span>");
  }
  return entries;
}

}  // namespace orbweave
