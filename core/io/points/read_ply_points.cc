// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/points/read_ply_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/byte_stream.h"
#include "core/io/file.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

enum class Number { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

constexpr std::array<std::pair<std::string_view, Number>, 16> kNumbers = {
    {{"char", Number::kInt8},
     {"int8", Number::kInt8},
     {"uchar", Number::kUint8},
     {"uint8", Number::kUint8},
     {"short", Number::kInt16},
     {"int16", Number::kInt16},
     {"ushort", Number::kUint16},
     {"uint16", Number::kUint16},
     {"int", Number::kInt32},
     {"int32", Number::kInt32},
     {"uint", Number::kUint32},
     {"uint32", Number::kUint32},
     {"float", Number::kFloat},
     {"float32", Number::kFloat},
     {"double", Number::kDouble},
     {"float64", Number::kDouble}}};

struct Property {
  Number number = Number::kFloat;
  std::optional<Number> list_length{};  ///< present: a list, this its length's type
  int axis = -1;                        ///< 0, 1, 2: x, y, z
};

struct Element {
  std::string name{};
  uint64_t count = 0;
  std::vector<Property> properties{};

  [[nodiscard]] bool HasPositions() const {
    int axes = 0;
    for (const Property& property : properties) axes |= property.axis < 0 ? 0 : 1 << property.axis;
    return axes == 7;
  }
};

struct Header {
  bool ascii = false;
  std::vector<Element> elements{};  ///< up to "vertex"
};

absl::Status Broken(const std::string& name, std::string_view what) {
  return absl::InvalidArgumentError(
      absl::StrCat("'", name, "' is no PLY file of points that can be read: ", std::string(what)));
}

std::optional<Number> NumberNamed(std::string_view text) {
  for (const auto& [known, number] : kNumbers) {
    if (known == text) return number;
  }
  return std::nullopt;
}

std::optional<Property> PropertyFromWords(const std::vector<std::string_view>& words) {
  Property property;
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3) return std::nullopt;
  const std::optional<Number> number = NumberNamed(words[words.size() - 2]);
  if (!number) return std::nullopt;
  property.number = *number;
  if (list) {
    property.list_length = NumberNamed(words[2]);
    return property.list_length ? std::optional(property) : std::nullopt;
  }
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    if (words[2] == kAxes[static_cast<size_t>(axis)]) property.axis = axis;
  }
  return property;
}

/// Takes the next line, without its end, off the bytes.
std::string_view TakeLine(std::string_view& bytes) {
  const size_t end = bytes.find('\n');
  std::string_view line = bytes.substr(0, end);
  bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

absl::Status AddToHeader(std::string_view line, const std::string& name, Header& header) {
  const std::vector<std::string_view> words = SplitWords(line);
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return absl::OkStatus();
  if (words[0] == "format" && words.size() == 3) {
    header.ascii = words[1] == "ascii";
    if (header.ascii || words[1] == "binary_little_endian") return absl::OkStatus();
    return Broken(
        name, absl::StrCat("format ", std::string(words[1]), "; ascii or binary_little_endian"));
  }
  if (words[0] == "element" && words.size() == 3) {
    const std::optional<double> count = NumberFromText(words[2]);
    if (!count || !(*count >= 0.0 && *count < 1e15)) return Broken(name, line);
    header.elements.push_back({std::string(words[1]), static_cast<uint64_t>(*count), {}});
    return absl::OkStatus();
  }
  const auto property = words[0] == "property" ? PropertyFromWords(words) : std::nullopt;
  if (!property || header.elements.empty()) {
    return Broken(name, absl::StrCat("line '", std::string(line.substr(0, 80)), "' of its header"));
  }
  header.elements.back().properties.push_back(*property);
  return absl::OkStatus();
}

/// Takes the header off the bytes.
absl::StatusOr<Header> TakeHeader(std::string_view& bytes, const std::string& name) {
  if (TakeLine(bytes) != "ply") return Broken(name, "it does not begin with 'ply'");
  Header header;
  bool has_format = false;
  while (!bytes.empty()) {
    const std::string_view line = TakeLine(bytes);
    if (line == "end_header") {
      if (!has_format) return Broken(name, "it names no format");
      return header;
    }
    has_format |= line.substr(0, 7) == "format ";
    ORBWEAVE_RETURN_IF_ERROR(AddToHeader(line, name, header));
  }
  return Broken(name, "its header has no end");
}

double TakeBinary(Number number, ByteReader& in) {
  switch (number) {
    case Number::kInt8:
      return in.Take<int8_t>();
    case Number::kUint8:
      return in.Take<uint8_t>();
    case Number::kInt16:
      return in.Take<int16_t>();
    case Number::kUint16:
      return in.Take<uint16_t>();
    case Number::kInt32:
      return in.Take<int32_t>();
    case Number::kUint32:
      return in.Take<uint32_t>();
    case Number::kFloat:
      return static_cast<double>(in.Take<float>());
    case Number::kDouble:
      return in.Take<double>();
  }
  return 0.0;
}

/// Numbers one after another: of a binary body, or of text.
class Body {
 public:
  Body(std::string_view bytes, bool ascii) : text_(bytes), binary_(bytes), ascii_(ascii) {}

  double Take(Number number) {
    if (!ascii_) return TakeBinary(number, binary_);
    const size_t begin = text_.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) text_ = {};
    text_.remove_prefix(text_.empty() ? 0 : begin);
    const size_t end = std::min(text_.find_first_of(" \t\r\n"), text_.size());
    const std::optional<double> value = NumberFromText(text_.substr(0, end));
    text_.remove_prefix(end);
    text_ok_ &= value.has_value();
    return value.value_or(0.0);
  }
  [[nodiscard]] bool ok() const { return text_ok_ && binary_.ok(); }

 private:
  std::string_view text_;
  ByteReader binary_;
  bool ascii_;
  bool text_ok_ = true;
};

Eigen::Vector3d TakeRecord(const Element& element, Body& body) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (const Property& property : element.properties) {
    const double length = property.list_length ? body.Take(*property.list_length) : 1.0;
    for (double i = 0; i < length && body.ok(); ++i) {
      const double value = body.Take(property.number);
      if (property.axis >= 0) point[property.axis] = value;
    }
  }
  return point;
}

}  // namespace

absl::StatusOr<std::vector<Eigen::Vector3d>> PlyPointsFromBytes(std::string_view bytes,
                                                                const std::string& name) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Header header, TakeHeader(bytes, name));
  Body body(bytes, header.ascii);
  for (const Element& element : header.elements) {
    const bool vertices = element.name == "vertex";
    if (vertices && !element.HasPositions()) return Broken(name, "its vertices lack x, y or z");
    if (element.properties.empty()) continue;
    std::vector<Eigen::Vector3d> points;
    for (uint64_t i = 0; i < element.count; ++i) {
      const Eigen::Vector3d point = TakeRecord(element, body);
      if (!body.ok()) {
        return Broken(name,
                      absl::StrCat("it ends, or is no number, within ",
                                   element.name,
                                   " ",
                                   i + 1,
                                   " of ",
                                   element.count));
      }
      if (vertices) points.push_back(point);
    }
    if (vertices) return points;
  }
  return Broken(name, "it has no element 'vertex'");
}

absl::StatusOr<std::vector<Eigen::Vector3d>> ReadPlyPoints(const std::string& path) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  return PlyPointsFromBytes(bytes, path);
}

}  // namespace orbweave
