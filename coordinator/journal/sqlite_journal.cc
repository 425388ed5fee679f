// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/sqlite_journal.h"

#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/journal/sql_journal.h"
#include "core/io/sqlite_connection.h"

namespace orbweave {
namespace {

/// Readers do not wait for the writer; a commit is on the disk when it returns.
constexpr const char* kSettings = "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL";

/// The words of SqliteConnection for a damaged file are meant for any database.
absl::Status AsJournal(const absl::Status& status, const std::string& path) {
  if (!absl::IsInvalidArgument(status)) return status;
  return absl::DataLossError(absl::StrCat("the journal ",
                                          path,
                                          " is damaged (",
                                          status.message(),
                                          "): put a copy of it back, or remove ",
                                          path,
                                          "* and submit its jobs again, which computes their "
                                          "tasks again"));
}

class SqliteRow final : public SqlRow {
 public:
  explicit SqliteRow(const SqliteStatement& statement) : statement_(statement) {}
  [[nodiscard]] bool IsNull(int column) const override { return statement_.IsNull(column); }
  [[nodiscard]] int64_t Integer(int column) const override { return statement_.Integer(column); }
  [[nodiscard]] double Number(int column) const override { return statement_.Number(column); }
  [[nodiscard]] std::string_view Bytes(int column) const override {
    return statement_.Blob(column);
  }

 private:
  const SqliteStatement& statement_;
};

struct Binder {
  SqliteStatement& statement;
  int index;
  void operator()(int64_t value) const { statement.Bind(index, value); }
  void operator()(double value) const { statement.Bind(index, value); }
  void operator()(std::string_view value) const { statement.Bind(index, value); }
  void operator()(const SqlBytes& value) const { statement.BindBlob(index, value.bytes); }
};

class SqliteDatabase final : public SqlDatabase {
 public:
  static absl::StatusOr<std::unique_ptr<SqlDatabase>> Open(const std::string& path) {
    ORBWEAVE_ASSIGN_OR_RETURN(SqliteConnection connection, SqliteConnection::OpenToWrite(path));
    std::unique_ptr<SqliteDatabase> database(new SqliteDatabase(path, std::move(connection)));
    ORBWEAVE_RETURN_IF_ERROR(AsJournal(database->connection_.Execute(kSettings), path));
    return database;
  }

  absl::Status Query(const std::string& sql,
                     const std::vector<SqlValue>& values,
                     const std::function<absl::Status(const SqlRow&)>& on_row) override {
    return AsJournal(QueryAsIs(sql, values, on_row), path_);
  }

  absl::Status Transact(const std::function<absl::Status()>& body) override {
    ORBWEAVE_RETURN_IF_ERROR(Execute("BEGIN IMMEDIATE"));
    absl::Status status = body();
    if (status.ok()) status = Execute("COMMIT");
    if (!status.ok()) Execute("ROLLBACK").IgnoreError();  // some errors have ended it already
    return status;
  }

 private:
  SqliteDatabase(std::string path, SqliteConnection connection)
      : path_(std::move(path)), connection_(std::move(connection)) {}

  absl::StatusOr<SqliteStatement*> Prepared(const std::string& sql) {
    const auto it = statements_.find(sql);
    if (it != statements_.end()) return &it->second;
    ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement statement, connection_.Prepare(sql));
    return &statements_.emplace(sql, std::move(statement)).first->second;
  }

  absl::Status QueryAsIs(const std::string& sql,
                         const std::vector<SqlValue>& values,
                         const std::function<absl::Status(const SqlRow&)>& on_row) {
    ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement * statement, Prepared(sql));
    for (size_t i = 0; i < values.size(); ++i)
      std::visit(Binder{*statement, static_cast<int>(i) + 1}, values[i]);
    const absl::Status status = StepThrough(*statement, on_row);
    statement->Reset();
    return status;
  }

  static absl::Status StepThrough(SqliteStatement& statement,
                                  const std::function<absl::Status(const SqlRow&)>& on_row) {
    while (true) {
      ORBWEAVE_ASSIGN_OR_RETURN(const bool more, statement.Step());
      if (!more) return absl::OkStatus();
      ORBWEAVE_RETURN_IF_ERROR(on_row(SqliteRow(statement)));
    }
  }

  std::string path_;
  SqliteConnection connection_;
  std::map<std::string, SqliteStatement> statements_;
};

/// Looks at every page: a journal that is damaged somewhere is better not written to.
absl::Status CheckWhole(SqlDatabase& database, const std::string& path) {
  return database.Query("PRAGMA quick_check(1)", {}, [&path](const SqlRow& row) {
    if (row.Bytes(0) == "ok") return absl::OkStatus();
    return AsJournal(absl::InvalidArgumentError(std::string(row.Bytes(0))), path);
  });
}

}  // namespace

absl::StatusOr<std::unique_ptr<Journal>> OpenSqliteJournal(const std::string& path) {
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<SqlDatabase> writer, SqliteDatabase::Open(path));
  ORBWEAVE_RETURN_IF_ERROR(CheckWhole(*writer, path));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<SqlDatabase> reader, SqliteDatabase::Open(path));
  return SqlJournal::Open(std::move(writer), std::move(reader));
}

}  // namespace orbweave
