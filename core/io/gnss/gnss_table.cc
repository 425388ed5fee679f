// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/gnss/gnss_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/first_names.h"
#include "core/io/gnss/gnss_angle.h"
#include "core/io/gnss/gnss_cells.h"
#include "core/io/plausible.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

/// Cells of one kind that are not used, counted.
class Doubts {
 public:
  /// `what`: "an altitude that cannot be".
  void Add(const std::string& what, int line, const std::string& cell) {
    cells_[what].push_back(absl::StrCat("line ", line, " ('", cell.substr(0, kShown), "')"));
  }
  /// "2 rows of gnss.csv have an altitude that cannot be and is not used: line 3 ('1e308'), ..."
  [[nodiscard]] std::vector<std::string> Warnings(std::string_view source) const {
    std::vector<std::string> warnings;
    for (const auto& [what, cells] : cells_) {
      warnings.push_back(absl::StrCat(cells.size(),
                                      cells.size() == 1 ? " row of " : " rows of ",
                                      std::string(source),
                                      cells.size() == 1 ? " has " : " have ",
                                      what,
                                      ": ",
                                      FirstNames(cells, kCellsShown)));
    }
    return warnings;
  }

 private:
  static constexpr size_t kShown = 40;
  static constexpr size_t kCellsShown = 3;
  std::map<std::string, std::vector<std::string>> cells_{};
};

/// "60", or the 60 of "60 m Above Sea Level", "60 m Below Sea Level" being -60.
std::optional<double> FiniteNumber(const std::string& text) {
  const std::vector<std::string_view> words = SplitWords(text);
  const std::optional<double> number = words.empty() ? std::nullopt : NumberFromText(words.front());
  if (!number || !std::isfinite(*number)) return std::nullopt;
  const bool below = std::find(words.begin(), words.end(), "Below") != words.end();
  return below ? -*number : *number;
}

bool FitsOnlySwapped(double latitude, double longitude) {
  return std::abs(latitude) > 90.0 && std::abs(latitude) <= 180.0 && std::abs(longitude) <= 90.0;
}

/// The number of a cell; nullopt where there is none or, with a doubt, where it cannot be.
std::optional<double> Believed(const GnssCells& raw,
                               GnssColumn column,
                               bool (*is_plausible)(double),
                               const char* what,
                               Doubts& doubts) {
  const std::string& cell = raw.cells[column];
  const std::optional<double> number = FiniteNumber(cell);
  if (number && is_plausible(*number)) return number;
  if (!cell.empty()) doubts.Add(absl::StrCat(what, " and is not used"), raw.line, cell);
  return std::nullopt;
}

/// The same for a standard deviation, where 0 and less mean that none is stated.
std::optional<double> BelievedSigma(const GnssCells& raw,
                                    GnssColumn column,
                                    bool (*is_plausible)(double),
                                    Doubts& doubts) {
  const std::optional<double> number = FiniteNumber(raw.cells[column]);
  if (number && *number <= 0.0) return std::nullopt;
  return Believed(raw, column, is_plausible, "an accuracy that cannot be", doubts);
}

/// Fills the position; returns why there is none, or an empty text.
std::string ReadGeodetic(const GnssCells& raw, GnssRow& row, Doubts& doubts) {
  if (raw.cells[kLatitude].empty() && raw.cells[kLongitude].empty()) return "it has no position";
  const std::optional<double> latitude = GnssAngle(raw.cells[kLatitude], "NS");
  const std::optional<double> longitude = GnssAngle(raw.cells[kLongitude], "EW");
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
  const std::optional<double> altitude =
      Believed(raw, kAltitude, IsPlausibleHeight, "an altitude that cannot be", doubts);
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
    if (!IsPlausibleCoordinate(*value)) return absl::StrCat("coordinate ", cell, " is nowhere");
    position[axis] = *value;
  }
  row.position_in_local = position;
  return "";
}

/// Accuracies, and the fix type that stands in for them.
void ReadQuality(const GnssCells& raw, GnssRow& row, Doubts& doubts) {
  if (FiniteNumber(raw.cells[kAccuracy]).value_or(0.0) > kLargestSigma_m) {
    row.geodetic.reset();
    row.position_in_local.reset();
    doubts.Add(
        "an accuracy beyond 10 km: its position is not used", raw.line, raw.cells[kAccuracy]);
  } else {
    row.accuracy_m = BelievedSigma(raw, kAccuracy, IsPlausibleSigma, doubts);
  }
  if (FiniteNumber(raw.cells[kVerticalAccuracy]).value_or(0.0) > kLargestSigma_m) {
    row.vertical_accuracy_m = kUnknownHeightSigma_m;
  } else {
    row.vertical_accuracy_m = BelievedSigma(raw, kVerticalAccuracy, IsPlausibleSigma, doubts);
  }
  row.fix = GnssFixFromText(raw.cells[kFix]);
  if (!row.fix && !raw.cells[kFix].empty())
    doubts.Add("a fix type that nobody knows", raw.line, raw.cells[kFix]);
}

void ReadDirection(const GnssCells& raw, GnssRow& row, Doubts& doubts) {
  constexpr const char* kWhat = "a heading, pitch or roll that cannot be";
  row.heading_deg = Believed(raw, kHeading, IsPlausibleHeading, kWhat, doubts);
  row.pitch_deg = Believed(raw, kPitch, IsPlausiblePitch, kWhat, doubts);
  row.roll_deg = Believed(raw, kRoll, IsPlausibleRoll, kWhat, doubts);
  const auto sigma = [&](GnssColumn column) {
    return BelievedSigma(raw, column, IsPlausibleDirectionSigma, doubts);
  };
  row.heading_sigma_deg = sigma(kHeadingAccuracy);
  row.tilt_sigma_deg = std::max(sigma(kPitchAccuracy), sigma(kRollAccuracy));
}

void ReadTime(const GnssCells& raw, GnssRow& row, Doubts& doubts) {
  const std::string& cell = raw.cells[kTime];
  row.capture_time_s = TimeFromText(cell);
  if (row.capture_time_s && !std::isfinite(*row.capture_time_s)) row.capture_time_s.reset();
  // Later than the year 5000 in seconds: it is counted in thousandths, or smaller.
  constexpr double kLatest_s = 1e11;
  while (row.capture_time_s && std::abs(*row.capture_time_s) > kLatest_s)
    *row.capture_time_s /= 1000.0;
  if (!row.capture_time_s && !cell.empty())
    doubts.Add("a time that cannot be read", raw.line, cell);
}

std::string ReadRow(const GnssCells& raw, bool local, GnssRow& row, Doubts& doubts) {
  row.line = raw.line;
  row.name = raw.cells[kName];
  std::replace(row.name.begin(), row.name.end(), '\\', '/');
  if (!raw.problem.empty()) return raw.problem;
  if (row.name.empty()) return "it names no image";
  std::string problem = local ? ReadLocal(raw, row) : ReadGeodetic(raw, row, doubts);
  ReadQuality(raw, row, doubts);
  ReadDirection(raw, row, doubts);
  ReadTime(raw, row, doubts);
  if (!raw.cells[kDrive].empty()) row.drive = raw.cells[kDrive];
  if (row.fix != GnssFix::kNone) return problem;
  row.geodetic.reset();
  row.position_in_local.reset();
  doubts.Add("no fix: its position is not used", raw.line, raw.cells[kFix]);
  return "";
}

/// An error when at least half of the rows make sense only with latitude and longitude exchanged.
absl::Status CheckNotSwapped(const std::vector<GnssCells>& rows, std::string_view source) {
  size_t readable = 0;
  size_t swapped = 0;
  const GnssCells* example = nullptr;
  for (const GnssCells& row : rows) {
    const std::optional<double> latitude = GnssAngle(row.cells[kLatitude], "NS");
    const std::optional<double> longitude = GnssAngle(row.cells[kLongitude], "EW");
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
  Doubts doubts;
  std::map<std::string, int> line_of_name;
  for (const GnssCells& raw : raw_rows) {
    GnssRow row;
    std::string problem = ReadRow(raw, local, row, doubts);
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
  table.warnings = doubts.Warnings(source);
  return table;
}

absl::Status NothingUsable(const GnssTable& table, std::string_view source) {
  std::string text = absl::StrCat(std::string(source), ": no row gives a position");
  for (const std::string& warning : table.warnings) absl::StrAppend(&text, "; ", warning);
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
  const bool placed = std::ranges::any_of(
      table.rows, [](const GnssRow& row) { return row.geodetic || row.position_in_local; });
  if (!placed) return NothingUsable(table, source);
  return table;
}

}  // namespace orbweave
