// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss/gnss_cells.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

constexpr std::string_view kPosTxtMark = "#F=";

/// Accepted headers per column, in lower case, best first.
constexpr std::array<std::array<std::string_view, 10>, kNumGnssColumns> kAliases = {{
    {"name", "sourcefile", "file", "filename", "image", "image_name"},
    {"latitude", "lat", "gpslatitude"},
    {"longitude", "lon", "lng", "long", "gpslongitude"},
    {"altitude", "alt", "height", "elevation", "gpsaltitude"},
    {"x"},
    {"y"},
    {"z"},
    {"accuracy",
     "horizontal_accuracy",
     "accuracy_m",
     "sigma",
     "sigma_horizontal",
     "hacc",
     "gpshpositioningerror"},
    {"heading", "yaw", "poseheadingdegrees", "gpsimgdirection"},
    {"pitch", "posepitchdegrees"},
    {"roll", "poserolldegrees"},
    {"time",
     "capture_time",
     "timestamp",
     "datetime",
     "date_time",
     "time_s",
     "capture_time_s",
     "gpsdatetime",
     "subsecdatetimeoriginal",
     "datetimeoriginal"},
    {"drive", "sequence"},
    {"vertical_accuracy", "vertical_accuracy_m", "sigma_vertical", "sigma_up", "vacc"},
    {"fix", "fix_type", "fixtype", "gnss_fix", "gps_fix", "fix_quality", "gps_quality", "quality"},
    {"heading_accuracy", "heading_sigma", "yaw_accuracy", "yaw_sigma"},
    {"pitch_accuracy", "pitch_sigma"},
    {"roll_accuracy", "roll_sigma"},
}};

/// Where each column stands in the file; -1: nowhere.
using ColumnPlaces = std::array<int, kNumGnssColumns>;

char SeparatorOf(std::string_view header) {
  char best = ' ';
  std::ptrdiff_t most = 0;
  for (const char separator : {',', ';', '\t'}) {
    const std::ptrdiff_t count = std::count(header.begin(), header.end(), separator);
    if (count > most) {
      most = count;
      best = separator;
    }
  }
  return best;
}

std::vector<std::string> Cells(std::string_view line, char separator) {
  if (separator != ' ') return SplitFields(line, separator);
  std::vector<std::string> cells;
  for (const std::string_view word : SplitWords(line)) cells.emplace_back(word);
  return cells;
}

ColumnPlaces PlacesFromHeader(const std::vector<std::string>& header) {
  ColumnPlaces places;
  places.fill(-1);
  for (size_t column = 0; column < kNumGnssColumns; ++column) {
    for (const std::string_view alias : kAliases[column]) {
      for (size_t i = 0; i < header.size() && places[column] < 0 && !alias.empty(); ++i) {
        if (LowerText(header[i]) == alias) places[column] = static_cast<int>(i);
      }
    }
  }
  return places;
}

bool HasAll(const ColumnPlaces& places, std::initializer_list<GnssColumn> columns) {
  return std::all_of(
      columns.begin(), columns.end(), [&](GnssColumn column) { return places[column] >= 0; });
}

/// "it has 5 cells where the header names 3 ..." or nothing; empty cells at the end do not count.
std::string TooManyCells(const std::vector<std::string>& cells, size_t columns) {
  size_t used = cells.size();
  while (used > columns && cells[used - 1].empty()) --used;
  if (used <= columns) return "";
  return absl::StrCat("it has ",
                      used,
                      " cells where the header names ",
                      columns,
                      " (commas in numbers or names? write decimal points, quote names)");
}

/// Whether `text` is a number but for its decimal comma: "-122,32".
bool HasDecimalComma(std::string_view text) {
  const size_t comma = text.find(',');
  if (comma == std::string_view::npos || comma + 1 == text.size()) return false;
  std::string with_point(text);
  with_point[comma] = '.';
  return NumberFromText(with_point).has_value();
}

absl::Status DecimalCommaError(std::string_view source, int line, std::string_view number) {
  return absl::InvalidArgumentError(absl::StrCat(std::string(source),
                                                 " line ",
                                                 line,
                                                 ": the number '",
                                                 std::string(number),
                                                 "' has a decimal comma; write the table with "
                                                 "decimal points"));
}

/// An error that shows the first number with a decimal comma.
absl::Status CheckNoDecimalCommas(const std::vector<GnssCells>& rows, std::string_view source) {
  for (const GnssCells& row : rows) {
    for (size_t column = 0; column < kNumGnssColumns; ++column) {
      if (column != kName && column != kDrive && HasDecimalComma(row.cells[column]))
        return DecimalCommaError(source, row.line, row.cells[column]);
    }
  }
  return absl::OkStatus();
}

/// The same for lines of words between blanks and commas, where such a number is two words.
absl::Status CheckNoDecimalCommas(const std::vector<std::string_view>& lines,
                                  size_t header_line,
                                  std::string_view source) {
  for (size_t i = header_line + 1; i < lines.size(); ++i) {
    if (lines[i].starts_with('#')) continue;
    for (const std::string_view word : SplitWords(lines[i], " \t")) {
      if (HasDecimalComma(word)) return DecimalCommaError(source, static_cast<int>(i) + 1, word);
    }
  }
  return absl::OkStatus();
}

/// Rows of a table with a header line. Rows without the needed cells keep them empty.
absl::StatusOr<std::vector<GnssCells>> ReadCsv(const std::vector<std::string_view>& lines,
                                               size_t header_line,
                                               std::string_view source) {
  const char separator = SeparatorOf(lines[header_line]);
  const std::vector<std::string> header = Cells(lines[header_line], separator);
  const ColumnPlaces places = PlacesFromHeader(header);
  if (!HasAll(places, {kName, kLatitude, kLongitude}) && !HasAll(places, {kName, kX, kY, kZ})) {
    return absl::InvalidArgumentError(
        absl::StrCat(std::string(source),
                     " line ",
                     header_line + 1,
                     ": the first line must name the columns, name,latitude,longitude,altitude or "
                     "name,x,y,z at least; it is '",
                     std::string(lines[header_line].substr(0, 120)),
                     "'"));
  }
  if (separator == ' ') ORBWEAVE_RETURN_IF_ERROR(CheckNoDecimalCommas(lines, header_line, source));
  std::vector<GnssCells> rows;
  for (size_t i = header_line + 1; i < lines.size(); ++i) {
    if (TrimmedText(lines[i]).empty() || lines[i].starts_with('#')) continue;
    const std::vector<std::string> cells = Cells(lines[i], separator);
    GnssCells& row = rows.emplace_back();
    row.line = static_cast<int>(i) + 1;
    // Between blanks a time of two words is one cell more.
    if (separator != ' ') row.problem = TooManyCells(cells, header.size());
    for (size_t column = 0; column < kNumGnssColumns; ++column) {
      const int place = places[column];
      if (place >= 0 && place < static_cast<int>(cells.size()))
        row.cells[column] = cells[static_cast<size_t>(place)];
    }
  }
  ORBWEAVE_RETURN_IF_ERROR(CheckNoDecimalCommas(rows, source));
  return rows;
}

/// Whether X and Y of a POS.txt are degrees: see the header.
bool LooksLikeDegrees(const std::vector<GnssCells>& rows) {
  double low[2] = {1e300, 1e300};
  double high[2] = {-1e300, -1e300};
  for (const GnssCells& row : rows) {
    for (int axis = 0; axis < 2; ++axis) {
      const double value = NumberFromText(row.cells[axis == 0 ? kX : kY]).value_or(NAN);
      if (!std::isfinite(value) || value == 0.0) continue;
      low[axis] = std::min(low[axis], value);
      high[axis] = std::max(high[axis], value);
    }
  }
  const bool possible =
      low[0] >= -180.0 && high[0] <= 180.0 && low[1] >= -180.0 && high[1] <= 180.0;
  const bool compact = high[0] - low[0] < 2.0 && high[1] - low[1] < 2.0;
  const bool away = std::max(std::abs(low[0]), std::abs(low[1])) > 2.0;
  return possible && compact && away;
}

/// SphereSfM's POS.txt; "R" stands for nine cells.
absl::StatusOr<std::vector<GnssCells>> ReadPosTxt(const std::vector<std::string_view>& lines,
                                                  size_t header_line,
                                                  std::string_view source) {
  ColumnPlaces places;
  places.fill(-1);
  int place = 0;
  for (const std::string_view token : SplitWords(lines[header_line].substr(kPosTxtMark.size()))) {
    if (token == "N") places[kName] = place;
    if (token == "X") places[kX] = place;
    if (token == "Y") places[kY] = place;
    if (token == "Z") places[kZ] = place;
    place += token == "R" ? 9 : 1;
  }
  if (!HasAll(places, {kName, kX, kY, kZ})) {
    return absl::InvalidArgumentError(
        absl::StrCat(std::string(source),
                     " line ",
                     header_line + 1,
                     ": the format line must name N, X, Y and Z, as in '#F=N X Y Z'"));
  }
  ORBWEAVE_RETURN_IF_ERROR(CheckNoDecimalCommas(lines, header_line, source));
  std::vector<GnssCells> rows;
  for (size_t i = header_line + 1; i < lines.size(); ++i) {
    const std::vector<std::string_view> words = SplitWords(lines[i]);
    if (words.empty() || words.front().starts_with('#')) continue;
    GnssCells& row = rows.emplace_back();
    row.line = static_cast<int>(i) + 1;
    for (const GnssColumn column : {kName, kX, kY, kZ}) {
      const size_t at = static_cast<size_t>(places[column]);
      if (at < words.size()) row.cells[column] = std::string(words[at]);
    }
  }
  if (LooksLikeDegrees(rows)) {
    for (GnssCells& row : rows) {
      row.cells[kLongitude] = std::exchange(row.cells[kX], "");
      row.cells[kLatitude] = std::exchange(row.cells[kY], "");
      row.cells[kAltitude] = std::exchange(row.cells[kZ], "");
    }
  }
  return rows;
}

}  // namespace

absl::StatusOr<std::vector<GnssCells>> ReadGnssCells(std::string_view text,
                                                     std::string_view source) {
  const std::vector<std::string_view> lines = SplitLines(text);
  size_t header_line = 0;
  while (header_line < lines.size() && TrimmedText(lines[header_line]).empty()) ++header_line;
  if (header_line == lines.size()) {
    return absl::InvalidArgumentError(absl::StrCat(std::string(source), ": the table is empty"));
  }
  return lines[header_line].starts_with(kPosTxtMark) ? ReadPosTxt(lines, header_line, source)
                                                     : ReadCsv(lines, header_line, source);
}

}  // namespace orbweave
