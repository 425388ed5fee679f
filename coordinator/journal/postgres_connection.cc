// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/postgres_connection.h"

#include <libpq-fe.h>

#include <bit>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"

namespace orbweave {
namespace {

/// Object identifiers of types, as in the server's pg_type.
constexpr Oid kBytea = 17;
constexpr Oid kInt8 = 20;
constexpr Oid kText = 25;
constexpr Oid kFloat8 = 701;

constexpr int kBinary = 1;

/// Numbers travel as 8 bytes, the highest first.
std::string ToNetwork(uint64_t value) {
  std::string bytes;
  for (int shift = 56; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<char>((value >> shift) & 0xff));
  return bytes;
}

uint64_t FromNetwork(std::string_view bytes) {
  uint64_t value = 0;
  for (const char byte : bytes) value = (value << 8) | static_cast<unsigned char>(byte);
  return value;
}

struct Parameter {
  Oid type = 0;
  std::string bytes{};
};

struct ToParameter {
  Parameter operator()(int64_t value) const {
    return {kInt8, ToNetwork(static_cast<uint64_t>(value))};
  }
  Parameter operator()(double value) const {
    return {kFloat8, ToNetwork(std::bit_cast<uint64_t>(value))};
  }
  Parameter operator()(std::string_view value) const { return {kText, std::string(value)}; }
  Parameter operator()(const SqlBytes& value) const { return {kBytea, std::string(value.bytes)}; }
};

class PostgresRow final : public SqlRow {
 public:
  PostgresRow(const PGresult* result, int row) : result_(result), row_(row) {}
  [[nodiscard]] bool IsNull(int column) const override {
    return PQgetisnull(result_, row_, column) == 1;
  }
  [[nodiscard]] int64_t Integer(int column) const override {
    return static_cast<int64_t>(FromNetwork(Bytes(column)));
  }
  [[nodiscard]] double Number(int column) const override {
    return std::bit_cast<double>(FromNetwork(Bytes(column)));
  }
  [[nodiscard]] std::string_view Bytes(int column) const override {
    return {PQgetvalue(result_, row_, column),
            static_cast<size_t>(PQgetlength(result_, row_, column))};
  }

 private:
  const PGresult* result_;
  int row_;
};

std::string TextOf(const char* message) {
  return std::string(absl::StripAsciiWhitespace(message == nullptr ? "" : message));
}

/// By class of the server's code (PostgreSQL's documentation, appendix A).
absl::Status StatusFromState(std::string_view state, const std::string& message) {
  const absl::string_view code(state.data(), state.size());
  if (code == "53100")
    return absl::ResourceExhaustedError(absl::StrCat(message, ": free some space on its disk"));
  if (code == "55P03") return absl::FailedPreconditionError(message);  // a lock is taken
  if (absl::StartsWith(code, "28") || absl::StartsWith(code, "42501"))
    return absl::PermissionDeniedError(message);
  if (absl::StartsWith(code, "XX00"))
    return absl::DataLossError(absl::StrCat(message, ": put a copy of the database back"));
  const bool passes = code.empty() || absl::StartsWith(code, "08") ||
                      absl::StartsWith(code, "40") || absl::StartsWith(code, "53") ||
                      absl::StartsWith(code, "57");
  return passes ? absl::UnavailableError(message) : absl::InternalError(message);
}

}  // namespace

void PostgresConnection::Finish::operator()(pg_conn* connection) const { PQfinish(connection); }

void PostgresConnection::Clear::operator()(pg_result* result) const { PQclear(result); }

absl::StatusOr<std::unique_ptr<PostgresConnection>> PostgresConnection::Open(
    std::string url, std::function<absl::Status(SqlDatabase&)> on_connect) {
  std::unique_ptr<PostgresConnection> connection(
      new PostgresConnection(std::move(url), std::move(on_connect)));
  ORBWEAVE_RETURN_IF_ERROR(connection->Connect());
  return connection;
}

bool PostgresConnection::IsOpen() const {
  return connection_ != nullptr && PQstatus(connection_.get()) == CONNECTION_OK;
}

absl::Status PostgresConnection::Connect() {
  // What the URL says comes later and counts more.
  constexpr const char* kKeys[] = {
      "connect_timeout", "tcp_user_timeout", "client_encoding", "dbname", nullptr};
  const char* const values[] = {"10", "20000", "UTF8", url_.c_str(), nullptr};
  statements_.clear();
  connection_.reset(PQconnectdbParams(kKeys, values, /*expand_dbname=*/1));
  if (!IsOpen()) {
    const std::string why = TextOf(PQerrorMessage(connection_.get()));
    return absl::UnavailableError(absl::StrCat("cannot reach the journal's database: ", why));
  }
  PQsetNoticeProcessor(
      connection_.get(), [](void*, const char*) {}, nullptr);
  const bool was_pinned = std::exchange(is_pinned_, true);
  absl::Status status = on_connect_(*this);
  is_pinned_ = was_pinned;
  if (!status.ok()) connection_.reset();
  return status;
}

absl::Status PostgresConnection::StatusOf(const pg_result* result) const {
  const ExecStatusType kind = PQresultStatus(result);
  if (kind == PGRES_COMMAND_OK || kind == PGRES_TUPLES_OK) return absl::OkStatus();
  const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  return StatusFromState(
      state == nullptr ? "" : state,
      absl::StrCat("the journal's database: ", TextOf(PQerrorMessage(connection_.get()))));
}

absl::StatusOr<std::string> PostgresConnection::Prepared(const std::string& sql,
                                                         const std::vector<SqlValue>& values) {
  const auto it = statements_.find(sql);
  if (it != statements_.end()) return it->second;
  std::vector<Oid> types;
  for (const SqlValue& value : values) types.push_back(std::visit(ToParameter{}, value).type);
  std::string name = absl::StrCat("s", statements_.size());
  const Result result(PQprepare(
      connection_.get(), name.c_str(), sql.c_str(), static_cast<int>(types.size()), types.data()));
  ORBWEAVE_RETURN_IF_ERROR(StatusOf(result.get()));
  statements_.emplace(sql, name);
  return name;
}

absl::Status PostgresConnection::Query(const std::string& sql,
                                       const std::vector<SqlValue>& values,
                                       const std::function<absl::Status(const SqlRow&)>& on_row) {
  if (is_pinned_) return QueryOnce(sql, values, on_row);
  if (IsOpen()) {
    absl::Status status = QueryOnce(sql, values, on_row);
    if (status.ok() || IsOpen()) return status;
  }
  ORBWEAVE_RETURN_IF_ERROR(Connect());
  return QueryOnce(sql, values, on_row);
}

absl::Status PostgresConnection::QueryOnce(
    const std::string& sql,
    const std::vector<SqlValue>& values,
    const std::function<absl::Status(const SqlRow&)>& on_row) {
  if (!IsOpen()) return absl::UnavailableError("the journal's database went away");
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string name, Prepared(sql, values));
  std::vector<Parameter> parameters;
  for (const SqlValue& value : values) parameters.push_back(std::visit(ToParameter{}, value));
  std::vector<const char*> pointers;
  std::vector<int> lengths;
  for (const Parameter& parameter : parameters) {
    pointers.push_back(parameter.bytes.data());
    lengths.push_back(static_cast<int>(parameter.bytes.size()));
  }
  const std::vector<int> formats(parameters.size(), kBinary);
  const Result result(PQexecPrepared(connection_.get(),
                                     name.c_str(),
                                     static_cast<int>(pointers.size()),
                                     pointers.data(),
                                     lengths.data(),
                                     formats.data(),
                                     kBinary));
  ORBWEAVE_RETURN_IF_ERROR(StatusOf(result.get()));
  for (int row = 0; row < PQntuples(result.get()); ++row) {
    ORBWEAVE_RETURN_IF_ERROR(on_row(PostgresRow(result.get(), row)));
  }
  return absl::OkStatus();
}

absl::Status PostgresConnection::TransactOnce(const std::function<absl::Status()>& body) {
  ORBWEAVE_RETURN_IF_ERROR(Execute("BEGIN"));
  is_pinned_ = true;
  absl::Status status = body();
  if (status.ok()) status = Execute("COMMIT");
  if (!status.ok() && IsOpen()) Execute("ROLLBACK").IgnoreError();
  is_pinned_ = false;
  return status;
}

absl::Status PostgresConnection::Transact(const std::function<absl::Status()>& body) {
  const absl::Status status = TransactOnce(body);
  const bool broke = !status.ok() && !IsOpen();
  return broke ? TransactOnce(body) : status;  // what is saved twice is saved once
}

}  // namespace orbweave
