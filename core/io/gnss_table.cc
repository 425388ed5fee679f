// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

constexpr std::string_view kPosTxtMark = "#F=";

/// What a column holds; the order of kAliases.
enum Column {
  kName,
  kLatitude,
  kLongitude,
  kAltitude,
  kX,
  kY,
  kZ,
  kAccuracy,
  kHeading,
  kPitch,
  kRoll,
  kTime,
  kDrive,
  kNumColumns
};

/// Accepted headers per column, in lower case, best first.
constexpr std::array<std::array<std::string_view, 6>, kNumColumns> kAliases = {{
    {"name", "sourcefile", "file", "filename", "image", "image_name"},
    {"latitude", "lat", "gpslatitude"},
    {"longitude", "lon", "lng", "long", "gpslongitude"},
    {"altitude", "alt", "height", "elevation", "gpsaltitude"},
    {"x"},
    {"y"},
    {"z"},
    {"accuracy", "horizontal_accuracy", "sigma", "gpshpositioningerror"},
    {"heading", "yaw", "poseheadingdegrees", "gpsimgdirection"},
    {"pitch", "posepitchdegrees"},
    {"roll", "poserolldegrees"},
    {"time", "capture_time", "timestamp", "datetimeoriginal"},
    {"drive", "sequence"},
}};

/// A row cut into cells: `cells[column]` is empty where the table has no such column.
struct RawRow {
  int line = 0;
  std::array<std::string, kNumColumns> cells{};
};

/// Where each column stands in the file; -1: nowhere.
using ColumnPlaces = std::array<int, kNumColumns>;

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
  for (size_t column = 0; column < kNumColumns; ++column) {
    for (const std::string_view alias : kAliases[column]) {
      for (size_t i = 0; i < header.size() && places[column] < 0 && !alias.empty(); ++i) {
        if (LowerText(header[i]) == alias) places[column] = static_cast<int>(i);
      }
    }
  }
  return places;
}

bool HasAll(const ColumnPlaces& places, std::initializer_list<Column> columns) {
  return std::all_of(
      columns.begin(), columns.end(), [&](Column column) { return places[column] >= 0; });
}

/// Rows of a table with a header line. Rows without the needed cells keep them empty.
absl::StatusOr<std::vector<RawRow>> ReadCsv(const std::vector<std::string_view>& lines,
                                            size_t header_line,
                                            std::string_view source) {
  const char separator = SeparatorOf(lines[header_line]);
  const ColumnPlaces places = PlacesFromHeader(Cells(lines[header_line], separator));
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
  std::vector<RawRow> rows;
  for (size_t i = header_line + 1; i < lines.size(); ++i) {
    if (TrimmedText(lines[i]).empty() || lines[i].starts_with('#')) continue;
    const std::vector<std::string> cells = Cells(lines[i], separator);
    RawRow& row = rows.emplace_back();
    row.line = static_cast<int>(i) + 1;
    for (size_t column = 0; column < kNumColumns; ++column) {
      const int place = places[column];
      if (place >= 0 && place < static_cast<int>(cells.size()))
        row.cells[column] = cells[static_cast<size_t>(place)];
    }
  }
  return rows;
}

/// Whether X and Y of a POS.txt are degrees: see the header.
bool LooksLikeDegrees(const std::vector<RawRow>& rows) {
  double low[2] = {1e300, 1e300};
  double high[2] = {-1e300, -1e300};
  for (const RawRow& row : rows) {
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
absl::StatusOr<std::vector<RawRow>> ReadPosTxt(const std::vector<std::string_view>& lines,
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
  std::vector<RawRow> rows;
  for (size_t i = header_line + 1; i < lines.size(); ++i) {
    const std::vector<std::string_view> words = SplitWords(lines[i]);
    if (words.empty() || words.front().starts_with('#')) continue;
    RawRow& row = rows.emplace_back();
    row.line = static_cast<int>(i) + 1;
    for (const Column column : {kName, kX, kY, kZ}) {
      const size_t at = static_cast<size_t>(places[column]);
      if (at < words.size()) row.cells[column] = std::string(words[at]);
    }
  }
  if (LooksLikeDegrees(rows)) {
    for (RawRow& row : rows) {
      row.cells[kLongitude] = std::exchange(row.cells[kX], "");
      row.cells[kLatitude] = std::exchange(row.cells[kY], "");
      row.cells[kAltitude] = std::exchange(row.cells[kZ], "");
    }
  }
  return rows;
}

/// Decimal degrees, or ExifTool's `47 deg 36' 36.70" N`.
std::optional<double> AngleFromText(const std::string& text) {
  if (const std::optional<double> number = NumberFromText(text)) return number;
  std::string numbers = text;
  for (char& c : numbers) {
    if ((c < '0' || c > '9') && c != '.') c = ' ';
  }
  double value = 0.0;
  double unit = 1.0;
  const std::vector<std::string_view> words = SplitWords(numbers);
  if (words.empty() || words.size() > 3) return std::nullopt;
  for (const std::string_view word : words) {
    const std::optional<double> part = NumberFromText(word);
    if (!part) return std::nullopt;
    value += *part * unit;
    unit /= 60.0;
  }
  const char letter = text.empty() ? ' ' : text.back();
  if (letter == 'S' || letter == 'W') return -value;
  return letter == 'N' || letter == 'E' ? std::optional(value) : std::nullopt;
}

/// "60", or the 60 of "60 m Above Sea Level".
std::optional<double> FiniteNumber(const std::string& text) {
  const std::vector<std::string_view> words = SplitWords(text);
  const std::optional<double> number = words.empty() ? std::nullopt : NumberFromText(words.front());
  return number && std::isfinite(*number) ? number : std::nullopt;
}

bool FitsOnlySwapped(double latitude, double longitude) {
  return std::abs(latitude) > 90.0 && std::abs(latitude) <= 180.0 && std::abs(longitude) <= 90.0;
}

/// Fills the position; returns why there is none, or an empty text.
std::string ReadGeodetic(const RawRow& raw, GnssRow& row) {
  if (raw.cells[kLatitude].empty() && raw.cells[kLongitude].empty()) return "it has no position";
  const std::optional<double> latitude = AngleFromText(raw.cells[kLatitude]);
  const std::optional<double> longitude = AngleFromText(raw.cells[kLongitude]);
  if (!latitude) return absl::StrCat("latitude '", raw.cells[kLatitude], "' is not a number");
  if (!longitude) return absl::StrCat("longitude '", raw.cells[kLongitude], "' is not a number");
  if (!std::isfinite(*latitude) || !std::isfinite(*longitude))
    return "its position is not a number";
  if (*latitude == 0.0 && *longitude == 0.0)
    return "its position is 0/0, as receivers write without a fix";
  if (std::abs(*latitude) > 90.0) {
    return absl::StrCat(
        "latitude ",
        *latitude,
        " is beyond 90 degrees",
        FitsOnlySwapped(*latitude, *longitude) ? " (swapped with the longitude?)" : "");
  }
  if (std::abs(*longitude) > 180.0)
    return absl::StrCat("longitude ", *longitude, " is beyond 180 degrees");
  const std::optional<double> altitude = FiniteNumber(raw.cells[kAltitude]);
  row.geodetic = GeodeticPosition{*latitude, *longitude, altitude.value_or(0.0)};
  row.altitude_known = altitude.has_value();
  return "";
}

std::string ReadLocal(const RawRow& raw, GnssRow& row) {
  Eigen::Vector3d position;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& cell = raw.cells[static_cast<size_t>(kX + axis)];
    const std::optional<double> value = FiniteNumber(cell);
    if (!value) return absl::StrCat("coordinate '", cell, "' is not a number");
    position[axis] = *value;
  }
  row.position_in_local = position;
  return "";
}

std::string ReadRow(const RawRow& raw, bool local, GnssRow& row) {
  row.line = raw.line;
  row.name = raw.cells[kName];
  std::replace(row.name.begin(), row.name.end(), '\\', '/');
  if (row.name.empty()) return "it names no image";
  std::string problem = local ? ReadLocal(raw, row) : ReadGeodetic(raw, row);
  row.accuracy_m = FiniteNumber(raw.cells[kAccuracy]);
  if (row.accuracy_m && *row.accuracy_m <= 0.0) row.accuracy_m.reset();
  row.heading_deg = FiniteNumber(raw.cells[kHeading]);
  row.pitch_deg = FiniteNumber(raw.cells[kPitch]);
  row.roll_deg = FiniteNumber(raw.cells[kRoll]);
  row.capture_time_s = TimeFromText(raw.cells[kTime]);
  if (!raw.cells[kDrive].empty()) row.drive = raw.cells[kDrive];
  return problem;
}

/// An error when at least half of the rows make sense only with latitude and longitude exchanged.
absl::Status CheckNotSwapped(const std::vector<RawRow>& rows, std::string_view source) {
  size_t readable = 0;
  size_t swapped = 0;
  const RawRow* example = nullptr;
  for (const RawRow& row : rows) {
    const std::optional<double> latitude = AngleFromText(row.cells[kLatitude]);
    const std::optional<double> longitude = AngleFromText(row.cells[kLongitude]);
    if (!latitude || !longitude) continue;
    ++readable;
    if (!FitsOnlySwapped(*latitude, *longitude)) continue;
    ++swapped;
    if (example == nullptr) example = &row;
  }
  if (example == nullptr || 2 * swapped < readable) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(std::string(source),
                   ": latitude and longitude look swapped (line ",
                   example->line,
                   ": latitude ",
                   example->cells[kLatitude],
                   " is beyond 90 degrees, longitude ",
                   example->cells[kLongitude],
                   " is not); exchange the two columns or their names"));
}

GnssTable ReadRows(const std::vector<RawRow>& raw_rows, bool local, std::string_view source) {
  GnssTable table;
  std::map<std::string, int> line_of_name;
  for (const RawRow& raw : raw_rows) {
    GnssRow row;
    std::string problem = ReadRow(raw, local, row);
    if (problem.empty()) {
      const auto [earlier, is_new] = line_of_name.emplace(row.name, row.line);
      if (!is_new) problem = absl::StrCat("it repeats line ", earlier->second);
    }
    if (problem.empty()) {
      table.rows.push_back(std::move(row));
    } else {
      table.rejected.push_back({absl::StrCat(std::string(source),
                                             " line ",
                                             raw.line,
                                             row.name.empty() ? "" : " (" + row.name + ")"),
                                problem});
    }
  }
  return table;
}

absl::Status NothingUsable(const GnssTable& table, std::string_view source) {
  std::string text = absl::StrCat(std::string(source), ": no row gives a position");
  for (size_t i = 0; i < std::min<size_t>(table.rejected.size(), 3); ++i) {
    absl::StrAppend(&text, "; ", table.rejected[i].name, ": ", table.rejected[i].reason);
  }
  return absl::InvalidArgumentError(text);
}

}  // namespace

absl::StatusOr<GnssTable> ParseGnssTable(std::string_view text, std::string_view source) {
  const std::vector<std::string_view> lines = SplitLines(text);
  size_t header_line = 0;
  while (header_line < lines.size() && TrimmedText(lines[header_line]).empty()) ++header_line;
  if (header_line == lines.size()) {
    return absl::InvalidArgumentError(absl::StrCat(std::string(source), ": the table is empty"));
  }
  const bool is_pos_txt = lines[header_line].starts_with(kPosTxtMark);
  ORBWEAVE_ASSIGN_OR_RETURN(
      const std::vector<RawRow> rows,
      is_pos_txt ? ReadPosTxt(lines, header_line, source) : ReadCsv(lines, header_line, source));
  const bool local =
      std::all_of(rows.begin(),
                  rows.end(),
                  [](const RawRow& row) {
                    return row.cells[kLatitude].empty() && row.cells[kLongitude].empty();
                  }) &&
      std::any_of(
          rows.begin(), rows.end(), [](const RawRow& row) { return !row.cells[kX].empty(); });
  if (!local) ORBWEAVE_RETURN_IF_ERROR(CheckNotSwapped(rows, source));
  GnssTable table = ReadRows(rows, local, source);
  if (table.rows.empty()) return NothingUsable(table, source);
  return table;
}

}  // namespace orbweave
