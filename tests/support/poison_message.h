// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "orbweave/v1/artifacts.pb.h"

/// Messages with numbers that no encoder writes. Which numbers a message has, packed ones too, the
/// format says itself: by reflection, and by the comments of its fields.

namespace orbweave::testing {

using Message = google::protobuf::Message;
using Field = google::protobuf::FieldDescriptor;

/// By "Message.field" the type of the elements of a packed array, as its comment has it.
inline std::map<std::string, std::string> PackedTypes() {
  std::map<std::string, std::string> types;
  for (const char* name : {"artifacts", "adjustment", "dense"}) {
    std::ifstream file(std::string(ORBWEAVE_SOURCE_DIR) + "/proto/orbweave/v1/" + name + ".proto");
    std::string message;
    for (std::string line; std::getline(file, line);) {
      if (const size_t at = line.find("message "); at != std::string::npos && at <= 2)
        message = line.substr(at + 8, line.find(' ', at + 8) - at - 8);
      const size_t bytes = line.find("bytes ");
      const size_t comment = line.find("// ");
      if (bytes == std::string::npos || comment == std::string::npos || comment < bytes) continue;
      const std::string field = line.substr(bytes + 6, line.find(' ', bytes + 6) - bytes - 6);
      types[message + "." + field] =
          line.substr(comment + 3, line.find_first_of(" ,;:", comment + 3) - comment - 3);
    }
  }
  return types;
}

/// Poisons the numbers of a message, one at a time, and shows each poisoned message.
class MessagePoisoner {
 public:
  /// `field`: "Message.field"; `poison`: what stands there now; `is_real`: a floating-point number
  /// that is none, or far beyond all that are.
  using Look =
      std::function<void(const std::string& field, const std::string& poison, bool is_real)>;

  /// Of an array no more than `max_elements` are poisoned, spread over it.
  explicit MessagePoisoner(Look look, size_t max_elements = std::numeric_limits<size_t>::max())
      : look_(std::move(look)), max_elements_(max_elements) {}

  void Visit(Message& message) {
    const auto& reflection = *message.GetReflection();
    std::vector<const Field*> fields;
    reflection.ListFields(message, &fields);
    for (const Field* field : fields) {
      if (!field->is_repeated()) {
        VisitSingle(message, *field);
        continue;
      }
      const auto size = static_cast<size_t>(reflection.FieldSize(message, field));
      ForSome(size, [&](size_t i) { VisitElement(message, *field, static_cast<int>(i)); });
    }
  }

 private:
  template <typename Number>
  static std::vector<Number> PoisonsOf() {
    if constexpr (std::floating_point<Number>) {
      constexpr Number kInfinity = std::numeric_limits<Number>::infinity();
      return {std::numeric_limits<Number>::quiet_NaN(),
              kInfinity,
              -kInfinity,
              std::numeric_limits<Number>::max() / 1e8F};
    } else {
      return {std::numeric_limits<Number>::max(), std::numeric_limits<Number>::min(), Number{1}};
    }
  }

  template <typename Visit>
  void ForSome(size_t count, const Visit& visit) const {
    const size_t taken = std::min(count, max_elements_);
    for (size_t i = 0; i < taken; ++i) visit(taken < 2 ? 0 : i * (count - 1) / (taken - 1));
  }

  /// Calls set(poison) for all poisons, then set(legal).
  template <typename Number, typename Set>
  void Poison(const Field& field, Number legal, const Set& set) {
    for (const Number poison : PoisonsOf<Number>()) {
      set(poison);
      look_(field.containing_type()->name() + "." + field.name(),
            std::to_string(poison),
            std::floating_point<Number>);
    }
    set(legal);
  }

  void VisitSingle(Message& message, const Field& field) {
    const auto& reflection = *message.GetReflection();
    switch (field.cpp_type()) {
      case Field::CPPTYPE_MESSAGE:
        return Visit(*reflection.MutableMessage(&message, &field));
      case Field::CPPTYPE_DOUBLE:
        return Poison(field, reflection.GetDouble(message, &field), [&](double value) {
          reflection.SetDouble(&message, &field, value);
        });
      case Field::CPPTYPE_UINT32:
        return Poison(field, reflection.GetUInt32(message, &field), [&](uint32_t value) {
          reflection.SetUInt32(&message, &field, value);
        });
      case Field::CPPTYPE_INT32:
        return Poison(field, reflection.GetInt32(message, &field), [&](int32_t value) {
          reflection.SetInt32(&message, &field, value);
        });
      case Field::CPPTYPE_UINT64:
        return Poison(field, reflection.GetUInt64(message, &field), [&](uint64_t value) {
          reflection.SetUInt64(&message, &field, value);
        });
      case Field::CPPTYPE_INT64:
        return Poison(field, reflection.GetInt64(message, &field), [&](int64_t value) {
          reflection.SetInt64(&message, &field, value);
        });
      default:
        break;
    }
    if (field.type() != Field::TYPE_BYTES) return;
    VisitBytes(field, reflection.GetString(message, &field), [&](const std::string& bytes) {
      reflection.SetString(&message, &field, bytes);
    });
  }

  void VisitElement(Message& message, const Field& field, int i) {
    const auto& reflection = *message.GetReflection();
    if (field.cpp_type() == Field::CPPTYPE_MESSAGE) {
      Visit(*reflection.MutableRepeatedMessage(&message, &field, i));
    } else if (field.cpp_type() == Field::CPPTYPE_UINT32) {
      Poison(field, reflection.GetRepeatedUInt32(message, &field, i), [&](uint32_t value) {
        reflection.SetRepeatedUInt32(&message, &field, i, value);
      });
    } else if (field.type() == Field::TYPE_BYTES) {
      const std::string legal = reflection.GetRepeatedString(message, &field, i);
      VisitBytes(field, legal, [&](const std::string& bytes) {
        reflection.SetRepeatedString(&message, &field, i, bytes);
      });
    }
  }

  template <typename Set>
  void VisitBytes(const Field& field, const std::string& legal, const Set& set) {
    const std::string name = field.containing_type()->name() + "." + field.name();
    const auto type = types_.find(name);
    ASSERT_NE(type, types_.end()) << name << ": its comment names no type";
    if (type->second == "double") VisitPacked<double>(field, legal, set);
    if (type->second == "float") VisitPacked<float>(field, legal, set);
    if (type->second == "uint32") VisitPacked<uint32_t>(field, legal, set);
    if (type->second == "int32") VisitPacked<int32_t>(field, legal, set);
    if (type->second == "uint64") VisitPacked<uint64_t>(field, legal, set);
    if (type->second == "int64") VisitPacked<int64_t>(field, legal, set);
    if (type->second == "int16") VisitPacked<int16_t>(field, legal, set);
    if (type->second == "uint8") VisitPacked<uint8_t>(field, legal, set);
    if (!legal.empty()) {
      set(legal.substr(1));
      look_(name, "a byte less", false);
    }
    set(legal);
  }

  template <typename Number, typename Set>
  void VisitPacked(const Field& field, const std::string& legal, const Set& set) {
    ForSome(legal.size() / sizeof(Number), [&](size_t i) {
      Number number{};
      std::memcpy(&number, &legal[i * sizeof(Number)], sizeof(Number));
      Poison(field, number, [&](Number value) {
        std::string bytes = legal;
        std::memcpy(&bytes[i * sizeof(Number)], &value, sizeof(Number));
        set(bytes);
      });
    });
  }

  Look look_;
  size_t max_elements_;
  std::map<std::string, std::string> types_ = PackedTypes();
};

}  // namespace orbweave::testing
