// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/sqlite_connection.h"

#include <sqlite3.h>

#include <filesystem>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr int kLongestWait_ms = 10'000;

absl::Status StatusFromSqlite(sqlite3* database, int code, const std::string& path) {
  const std::string text = absl::StrCat(
      path, ": ", database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code));
  switch (code & 0xff) {
    case SQLITE_FULL:
      return absl::ResourceExhaustedError(
          absl::StrCat(path, ": disk full; free some space and run again"));
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:
      return absl::InvalidArgumentError(
          absl::StrCat(text, "; not the database it should be, or damaged"));
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return absl::PermissionDeniedError(text);
    default:
      return absl::UnavailableError(text);
  }
}

}  // namespace

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

void SqliteStatement::Bind(int index, int64_t value) {
  sqlite3_bind_int64(statement_.get(), index, value);
}

void SqliteStatement::Bind(int index, double value) {
  sqlite3_bind_double(statement_.get(), index, value);
}

void SqliteStatement::Bind(int index, std::string_view text) {
  sqlite3_bind_text64(
      statement_.get(), index, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8);
}

void SqliteStatement::BindBlob(int index, std::string_view bytes) {
  sqlite3_bind_blob64(statement_.get(), index, bytes.data(), bytes.size(), SQLITE_STATIC);
}

void SqliteStatement::BindNull(int index) { sqlite3_bind_null(statement_.get(), index); }

absl::StatusOr<bool> SqliteStatement::Step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return StatusFromSqlite(sqlite3_db_handle(statement_.get()), code, path_);
}

void SqliteStatement::Reset() { sqlite3_reset(statement_.get()); }

absl::Status SqliteStatement::Run() {
  const absl::StatusOr<bool> stepped = Step();
  Reset();
  return stepped.status();
}

int64_t SqliteStatement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqliteStatement::Number(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

bool SqliteStatement::IsNull(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::string SqliteStatement::Text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return text == nullptr ? std::string() : std::string(text);
}

std::string_view SqliteStatement::Blob(int column) const {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  if (data == nullptr) return {};
  return {data, static_cast<size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

void SqliteConnection::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

absl::StatusOr<SqliteConnection> SqliteConnection::OpenToRead(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return absl::NotFoundError(absl::StrCat("there is no file ", path, "; check the path"));
  }
  SqliteConnection connection;
  connection.path_ = path;
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
  connection.database_.reset(database);
  if (code != SQLITE_OK) return StatusFromSqlite(database, code, path);
  sqlite3_busy_timeout(database, kLongestWait_ms);
  // Anybody may have made the file: its views and triggers get no functions with side effects.
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  ORBWEAVE_RETURN_IF_ERROR(connection.HasTable("images").status());  // reads the file's first page
  return connection;
}

absl::StatusOr<SqliteConnection> SqliteConnection::OpenToWrite(const std::string& path) {
  SqliteConnection connection;
  connection.path_ = path;
  sqlite3* database = nullptr;
  const int code =
      sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  connection.database_.reset(database);
  if (code != SQLITE_OK) return StatusFromSqlite(database, code, path);
  sqlite3_busy_timeout(database, kLongestWait_ms);
  return connection;
}

absl::Status SqliteConnection::Execute(const std::string& sql) const {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  return code == SQLITE_OK ? absl::OkStatus() : StatusFromSqlite(database_.get(), code, path_);
}

absl::StatusOr<SqliteStatement> SqliteConnection::Prepare(const std::string& sql) const {
  sqlite3_stmt* raw = nullptr;
  const int code =
      sqlite3_prepare_v2(database_.get(), sql.c_str(), static_cast<int>(sql.size()), &raw, nullptr);
  if (code != SQLITE_OK) return StatusFromSqlite(database_.get(), code, path_);
  SqliteStatement statement;
  statement.statement_.reset(raw);
  statement.path_ = path_;
  return statement;
}

absl::StatusOr<bool> SqliteConnection::HasTable(const std::string& table) const {
  ORBWEAVE_ASSIGN_OR_RETURN(
      SqliteStatement statement,
      Prepare("SELECT 1 FROM sqlite_master WHERE type IN ('table', 'view') AND name = ?"));
  statement.Bind(1, std::string_view(table));
  return statement.Step();
}

absl::StatusOr<bool> SqliteConnection::HasColumn(const std::string& table,
                                                 const std::string& column) const {
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement statement,
                            Prepare("SELECT 1 FROM pragma_table_info(?) WHERE name = ?"));
  statement.Bind(1, std::string_view(table));
  statement.Bind(2, std::string_view(column));
  return statement.Step();
}

}  // namespace orbweave
