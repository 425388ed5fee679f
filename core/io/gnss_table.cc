// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/gnss_cells.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

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
std::string ReadGeodetic(const GnssCells& raw, GnssRow& row) {
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

std::string ReadLocal(const GnssCells& raw, GnssRow& row) {
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

std::string ReadRow(const GnssCells& raw, bool local, GnssRow& row) {
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
absl::Status CheckNotSwapped(const std::vector<GnssCells>& rows, std::string_view source) {
  size_t readable = 0;
  size_t swapped = 0;
  const GnssCells* example = nullptr;
  for (const GnssCells& row : rows) {
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

GnssTable ReadRows(const std::vector<GnssCells>& raw_rows, bool local, std::string_view source) {
  GnssTable table;
  std::map<std::string, int> line_of_name;
  for (const GnssCells& raw : raw_rows) {
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

/// Whether the table has x, y, z and nowhere a latitude or longitude.
bool AreLocal(const std::vector<GnssCells>& rows) {
  const auto has = [&](GnssColumn column) {
    return std::any_of(
        rows.begin(), rows.end(), [&](const GnssCells& row) { return !row.cells[column].empty(); });
  };
  return has(kX) && !has(kLatitude) && !has(kLongitude);
}

}  // namespace

absl::StatusOr<GnssTable> ParseGnssTable(std::string_view text, std::string_view source) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<GnssCells> rows, ReadGnssCells(text, source));
  const bool local = AreLocal(rows);
  if (!local) ORBWEAVE_RETURN_IF_ERROR(CheckNotSwapped(rows, source));
  GnssTable table = ReadRows(rows, local, source);
  if (table.rows.empty()) return NothingUsable(table, source);
  return table;
}

}  // namespace orbweave
