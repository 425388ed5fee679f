// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/status.h"

namespace orbweave {

struct SqlBytes {
  std::string_view bytes{};
};
/// A value handed to a statement.
using SqlValue = std::variant<int64_t, double, std::string_view, SqlBytes>;

/// A row of an answer; columns count from 0 and have the type that is asked for.
class SqlRow {
 public:
  virtual ~SqlRow() = default;
  [[nodiscard]] virtual bool IsNull(int column) const = 0;
  [[nodiscard]] virtual int64_t Integer(int column) const = 0;
  [[nodiscard]] virtual double Number(int column) const = 0;
  /// Of a text or of bytes; valid until the next row.
  [[nodiscard]] virtual std::string_view Bytes(int column) const = 0;
};

/// A connection to a database, of the words that SQLite and PostgreSQL share: types BIGINT, DOUBLE
/// PRECISION, TEXT and BYTEA, parameters $1, $2, ... that appear first in this order. Used by one
/// thread at a time. Errors: those of Journal.
class SqlDatabase {
 public:
  virtual ~SqlDatabase() = default;

  /// Runs one statement and hands every row of its answer to `on_row`.
  [[nodiscard]] virtual absl::Status Query(
      const std::string& sql,
      const std::vector<SqlValue>& values,
      const std::function<absl::Status(const SqlRow&)>& on_row) = 0;
  [[nodiscard]] absl::Status Execute(const std::string& sql,
                                     const std::vector<SqlValue>& values = {}) {
    return Query(sql, values, [](const SqlRow&) { return absl::OkStatus(); });
  }

  /// Runs `body` in a transaction that is durable when this returns OK and undone otherwise. May
  /// run it twice, when a connection broke.
  [[nodiscard]] virtual absl::Status Transact(const std::function<absl::Status()>& body) = 0;
};

}  // namespace orbweave
