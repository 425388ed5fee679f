// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/process/announce.h"

#include <filesystem>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "cli/process/host_name.h"
#include "core/pipeline/build_version.h"
#include "core/storage/durable_file.h"
#include "security/tls_folder.h"
#include "worker/coordinator_address.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// Who listens on all addresses of a machine is reached by its name.
std::string ReachableAt(const std::string& address, const std::string& host) {
  if (absl::StartsWith(address, "unix:")) return address;
  const size_t colon = address.rfind(':');
  const std::string listened = address.substr(0, colon);
  const bool is_any = listened == "0.0.0.0" || listened == "[::]";
  const std::string name = !host.empty() ? host : is_any ? HostName() : listened;
  return absl::StrCat(name, address.substr(colon));
}

}  // namespace

void AddAnnounceArguments(CLI::App& command, AnnounceArgument& argument) {
  CLI::Option* const announce = command.add_option(
      "--announce",
      argument.path,
      "File to say in where this coordinator is, once it is ready; on storage that workers and "
      "clients see too, who name it as @FILE instead of an address");
  command
      .add_option("--announce-host",
                  argument.host,
                  "Host to name there (default: that of --listen, or this machine's name)")
      ->needs(announce);
}

absl::Status Announce(const AnnounceArgument& argument,
                      const std::string& address,
                      const std::string& tls_folder) {
  if (argument.path.empty()) return absl::OkStatus();
  Announcement announcement{.address = ReachableAt(address, argument.host),
                            .build = std::string(BuildVersion())};
  if (!tls_folder.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(const CertificateFacts own, CheckTlsFolder({tls_folder}));
    announcement.fleet = own.identity.fleet;
  }
  std::error_code error;
  const std::string folder = fs::absolute(argument.path, error).parent_path().string();
  return WriteFileDurably(folder, argument.path, AnnouncementToText(announcement));
}

void TakeBack(const AnnounceArgument& argument, const std::string& address) {
  if (argument.path.empty()) return;
  const absl::StatusOr<CoordinatorAddress> there = FindCoordinator("@" + argument.path);
  std::error_code ignored;
  if (there.ok() && there->address == ReachableAt(address, argument.host))
    fs::remove(argument.path, ignored);
}

}  // namespace orbweave
