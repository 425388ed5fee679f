// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pwd.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/command.h"

/// A real PostgreSQL server for tests.

namespace orbweave::testing {

/// The folder of PostgreSQL's server programs, the newest where there are several (Debian puts
/// every version in a folder of its own); empty when there is none.
inline std::string PostgresPrograms() {
  std::string newest;
  std::error_code none;
  for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", none)) {
    const std::string folder = (version.path() / "bin").string();
    if (std::filesystem::exists(folder + "/postgres")) newest = std::max(newest, folder);
  }
  return newest;
}

/// A server with a data folder of its own, listening on a unix socket in it; it ends with the
/// test. The server refuses to be root: then it runs as `nobody`. It does not wait for the disk
/// (-F): tests end processes, not machines.
class PostgresServer {
 public:
  /// nullptr: the server's programs are not installed, or do not start (said on stderr).
  static std::unique_ptr<PostgresServer> Start() {
    std::unique_ptr<PostgresServer> server(new PostgresServer);
    if (server->programs_.empty() || !server->MakeData() || !server->Resume()) return nullptr;
    return server;
  }
  ~PostgresServer() { Stop(); }

  /// Makes an empty database and returns how to reach it.
  [[nodiscard]] std::string MakeDatabase(const std::string& name) const {
    const CommandOutcome made = Run({programs_ + "/createdb", "-h", Data(), "-U", "test", name});
    if (made.exit_code != 0) fprintf(stderr, "%s\n", made.err.c_str());
    return "host=" + Data() + " user=test dbname=" + name;
  }

  /// Cuts off whoever uses a database, whatever they are doing, and lets nobody in until LetIn.
  void CutOff(const std::string& name) const {
    Order("ALTER DATABASE " + name + " ALLOW_CONNECTIONS false",
          "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = '" + name + "'");
  }
  void LetIn(const std::string& name) const {
    Order("ALTER DATABASE " + name + " ALLOW_CONNECTIONS true", "SELECT 1");
  }

  /// Ends it as an operator would: connections are cut, what was committed is kept.
  void Stop() {
    if (!process_) return;
    process_->Signal(SIGINT);
    (void)process_->Wait();
    process_.reset();
  }

  /// Starts it (again); false when it does not come up.
  [[nodiscard]] bool Resume() {
    process_.emplace(Unprivileged(
        {programs_ + "/postgres", "-D", Data(), "-k", Data(), "-c", "listen_addresses=", "-F"}));
    const auto is_ready = [this] {
      return Run({programs_ + "/pg_isready", "-q", "-h", Data()}).exit_code == 0;
    };
    if (WaitUntil(is_ready, 30.0)) return true;
    fprintf(stderr, "%s\n", process_->ErrSoFar().c_str());
    return false;
  }

 private:
  PostgresServer() = default;

  /// One after the other.
  void Order(const std::string& first, const std::string& second) const {
    const CommandOutcome done = Run({programs_ + "/psql",
                                     "-h",
                                     Data(),
                                     "-U",
                                     "test",
                                     "-d",
                                     "postgres",
                                     "-c",
                                     first,
                                     "-c",
                                     second});
    if (done.exit_code != 0) fprintf(stderr, "%s\n", done.err.c_str());
  }

  [[nodiscard]] std::string Data() const { return folder_ / "data"; }

  static std::vector<std::string> Unprivileged(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"/usr/bin/setpriv", "--pdeathsig", "INT"};
    if (geteuid() == 0) {
      all.insert(all.end(), {"--reuid", "nobody", "--regid", "nogroup", "--clear-groups"});
    }
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }

  static CommandOutcome Run(const std::vector<std::string>& arguments) {
    return RunCommand(Unprivileged(arguments));
  }

  [[nodiscard]] bool MakeData() const {
    std::filesystem::create_directory(Data());
    if (geteuid() == 0) {
      const passwd* nobody = getpwnam("nobody");
      for (const std::string& path : {folder_.Path(), Data()}) {
        if (nobody == nullptr || chown(path.c_str(), nobody->pw_uid, nobody->pw_gid) != 0)
          return false;
      }
    }
    const CommandOutcome made = Run({programs_ + "/initdb",
                                     "-D",
                                     Data(),
                                     "-U",
                                     "test",
                                     "-A",
                                     "trust",
                                     "-E",
                                     "UTF8",
                                     "--locale=C",
                                     "--no-sync"});
    if (made.exit_code != 0) fprintf(stderr, "%s\n", made.err.c_str());
    return made.exit_code == 0;
  }

  std::string programs_ = PostgresPrograms();
  TemporaryFolder folder_;
  std::optional<Command> process_;
};

}  // namespace orbweave::testing
