// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/postgres_journal.h"

#include <libpq-fe.h>

#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/journal/postgres_connection.h"
#include "coordinator/journal/sql_journal.h"

namespace orbweave {
namespace {

absl::Status CheckUrl(const std::string& url) {
  char* error = nullptr;
  const std::unique_ptr<PQconninfoOption, void (*)(PQconninfoOption*)> parsed(
      PQconninfoParse(url.c_str(), &error), PQconninfoFree);
  const std::unique_ptr<char, void (*)(void*)> message(error, PQfreemem);
  if (parsed == nullptr) {  // the message may quote a password
    return absl::InvalidArgumentError(
        "the journal is no address of a PostgreSQL database; it looks like "
        "postgresql://user@host/database");
  }
  for (const PQconninfoOption* option = parsed.get(); option->keyword != nullptr; ++option) {
    if (std::string_view(option->keyword) != "password" || option->val == nullptr) continue;
    return absl::InvalidArgumentError(
        "the address of the journal holds a password, which others can read in the list of "
        "processes; change it, and put it into ~/.pgpass or the file that PGPASSFILE names");
  }
  return absl::OkStatus();
}

/// A server that lost sight of the coordinator's machine frees its lock after about half a minute.
/// A coordinator that was killed and started again may come before the server has seen it go: wait
/// a little.
absl::Status TakeLock(SqlDatabase& database) {
  for (const char* setting : {"SET tcp_keepalives_idle = 10",
                              "SET tcp_keepalives_interval = 5",
                              "SET tcp_keepalives_count = 4",
                              "SET synchronous_commit = on",
                              "SET lock_timeout = '3s'"}) {
    ORBWEAVE_RETURN_IF_ERROR(database.Execute(setting));
  }
  const absl::Status locked =
      database.Execute("SELECT pg_advisory_lock(hashtext('orbweave'), hashtext(current_schema()))");
  if (!absl::IsFailedPrecondition(locked)) return locked;
  return absl::FailedPreconditionError("the journal is in use by another coordinator");
}

}  // namespace

absl::StatusOr<std::unique_ptr<Journal>> OpenPostgresJournal(const std::string& url) {
  ORBWEAVE_RETURN_IF_ERROR(CheckUrl(url));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<SqlDatabase> writer,
                            PostgresConnection::Open(url, TakeLock));
  ORBWEAVE_ASSIGN_OR_RETURN(
      std::unique_ptr<SqlDatabase> reader,
      PostgresConnection::Open(url, [](SqlDatabase&) { return absl::OkStatus(); }));
  return SqlJournal::Open(std::move(writer), std::move(reader));
}

}  // namespace orbweave
