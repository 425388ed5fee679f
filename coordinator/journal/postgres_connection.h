// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "coordinator/journal/sql_database.h"

struct pg_conn;
struct pg_result;

namespace orbweave {

/// A connection to a PostgreSQL server. One that broke is opened anew when it is needed next.
class PostgresConnection final : public SqlDatabase {
 public:
  /// `url` as libpq knows it: "postgresql://user@host/database" or "service=name". `on_connect`
  /// runs whenever a connection was opened, before anything else. Unavailable: the server does not
  /// answer; PermissionDenied: it does not let us in.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<PostgresConnection>> Open(
      std::string url, std::function<absl::Status(SqlDatabase&)> on_connect);

  [[nodiscard]] absl::Status Query(
      const std::string& sql,
      const std::vector<SqlValue>& values,
      const std::function<absl::Status(const SqlRow&)>& on_row) override;
  [[nodiscard]] absl::Status Transact(const std::function<absl::Status()>& body) override;

 private:
  struct Finish {
    void operator()(pg_conn* connection) const;
  };
  struct Clear {
    void operator()(pg_result* result) const;
  };
  using Result = std::unique_ptr<pg_result, Clear>;

  PostgresConnection(std::string url, std::function<absl::Status(SqlDatabase&)> on_connect)
      : url_(std::move(url)), on_connect_(std::move(on_connect)) {}
  [[nodiscard]] bool IsOpen() const;
  [[nodiscard]] absl::Status Connect();
  [[nodiscard]] absl::Status QueryOnce(const std::string& sql,
                                       const std::vector<SqlValue>& values,
                                       const std::function<absl::Status(const SqlRow&)>& on_row);
  [[nodiscard]] absl::Status TransactOnce(const std::function<absl::Status()>& body);
  /// The name of the prepared statement for `sql`.
  [[nodiscard]] absl::StatusOr<std::string> Prepared(const std::string& sql,
                                                     const std::vector<SqlValue>& values);
  [[nodiscard]] absl::Status StatusOf(const pg_result* result) const;

  std::string url_;
  std::function<absl::Status(SqlDatabase&)> on_connect_;
  std::unique_ptr<pg_conn, Finish> connection_;
  std::map<std::string, std::string> statements_;  ///< by their text
  bool is_pinned_ = false;                         ///< what runs is void when its connection breaks
};

}  // namespace orbweave
