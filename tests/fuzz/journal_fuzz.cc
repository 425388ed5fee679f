// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/sqlite_journal.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/temporary_folder.h"

FUZZ_TARGET(journal) {
  static const orbweave::TemporaryFolder folder;
  for (const char* name : {"journal.db-wal", "journal.db-shm"}) folder.Remove(name);
  const std::string path = folder.Write("journal.db", orbweave::BytesOf(data, size));
  const auto journal = orbweave::OpenSqliteJournal(path);
  if (!journal.ok()) return;
  (void)(*journal)->LoadJobs();
  (void)(*journal)->LoadOpenAttempts();
  (void)(*journal)->LoadAttempts(orbweave::DigestOf("task"));
  (void)(*journal)->LoadResults({orbweave::DigestOf("task")});
}
