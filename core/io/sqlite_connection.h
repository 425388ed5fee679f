// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

struct sqlite3;
struct sqlite3_stmt;

namespace orbweave {

/// One prepared statement. Bind from 1, step through the rows, read columns from 0; Reset to bind
/// anew. A bound text or blob must live until the last Step. Blob columns are valid until the next
/// Step.
class SqliteStatement {
 public:
  void Bind(int index, int64_t value);
  void Bind(int index, double value);
  void Bind(int index, std::string_view text);
  void BindBlob(int index, std::string_view bytes);
  void BindNull(int index);
  /// True: a row is ready; false: done. InvalidArgument: the file is damaged; ResourceExhausted:
  /// disk full; Unavailable otherwise.
  [[nodiscard]] absl::StatusOr<bool> Step();
  void Reset();
  /// Steps a statement without rows and makes it ready to be bound again.
  [[nodiscard]] absl::Status Run();

  [[nodiscard]] int64_t Integer(int column) const;
  [[nodiscard]] double Number(int column) const;
  [[nodiscard]] bool IsNull(int column) const;
  [[nodiscard]] std::string Text(int column) const;
  [[nodiscard]] std::string_view Blob(int column) const;

 private:
  friend class SqliteConnection;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string path_;
};

/// An open SQLite file. Whoever meets a lock of another connection, as at a checkpoint or while one
/// puts the log of a killed process in order, waits for it, up to ten seconds.
class SqliteConnection {
 public:
  /// NotFound: no such file. InvalidArgument: it is not an SQLite database.
  [[nodiscard]] static absl::StatusOr<SqliteConnection> OpenToRead(const std::string& path);
  /// Opens `path` to read and write, and creates it when there is none. Codes of
  /// WriteFileAtomically.
  [[nodiscard]] static absl::StatusOr<SqliteConnection> OpenToWrite(const std::string& path);

  [[nodiscard]] absl::Status Execute(const std::string& sql) const;
  [[nodiscard]] absl::StatusOr<SqliteStatement> Prepare(const std::string& sql) const;
  [[nodiscard]] absl::StatusOr<bool> HasTable(const std::string& table) const;
  [[nodiscard]] absl::StatusOr<bool> HasColumn(const std::string& table,
                                               const std::string& column) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
  std::string path_;
};

}  // namespace orbweave
