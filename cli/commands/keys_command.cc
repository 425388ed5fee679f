// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/keys_command.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "cli/process/exit_code.h"
#include "cli/process/host_name.h"
#include "security/join_token.h"
#include "security/key_store.h"
#include "security/unix_time.h"

namespace orbweave {
namespace {

constexpr int64_t kMinute_s = 60;
constexpr int64_t kDay_s = 86400;

struct KeysOptions {
  std::string store{};
  std::string fleet{};
  std::string role{};
  std::string name{};
  std::vector<std::string> hosts{};
  std::string serial{};
  std::string token{};
  std::string token_path{};
  int64_t days = 365;
  double minutes = 60.0;
  uint32_t uses = 1;
};

/// What is always said of a coordinator's machine, and what the command line adds.
std::vector<std::string> HostsOf(const KeysOptions& options) {
  std::vector<std::string> hosts = {"localhost", "127.0.0.1", "::1", HostName()};
  hosts.insert(hosts.end(), options.hosts.begin(), options.hosts.end());
  return hosts;
}

absl::Status Init(const KeysOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(MakeKeyStore(options.store, options.fleet, HostsOf(options), UnixNow()));
  std::printf(
      "keys of fleet %s made in %s: coordinator, client, admin; keep authority to yourself\n",
      options.fleet.c_str(),
      options.store.c_str());
  return absl::OkStatus();
}

absl::Status Add(const KeysOptions& options) {
  NewKeys keys{.name = options.name, .valid_s = options.days * kDay_s};
  ORBWEAVE_ASSIGN_OR_RETURN(keys.role, RoleFromName(options.role));
  if (keys.role == Role::kCoordinator) keys.hosts = HostsOf(options);
  ORBWEAVE_RETURN_IF_ERROR(AddKeys(options.store, keys, UnixNow()));
  std::printf("%s %s: %s/%s\n",
              options.role.c_str(),
              keys.name.c_str(),
              options.store.c_str(),
              keys.name.c_str());
  return absl::OkStatus();
}

absl::Status Token(const KeysOptions& options) {
  const auto valid_s = static_cast<int64_t>(options.minutes * static_cast<double>(kMinute_s));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const std::string number,
      WriteJoinToken(options.store, options.token_path, UnixNow() + valid_s, options.uses));
  const std::string workers =
      options.uses == 1 ? "one worker" : absl::StrCat(options.uses, " workers");
  std::printf("join token %s written to %s: good for %s and %g minutes\n",
              number.c_str(),
              options.token_path.c_str(),
              workers.c_str(),
              options.minutes);
  return absl::OkStatus();
}

absl::Status Shut(const KeysOptions& options) {
  Revocations more;
  if (!options.name.empty()) more.names.insert(options.name);
  if (!options.serial.empty()) more.serials.insert(absl::AsciiStrToUpper(options.serial));
  if (!options.token.empty()) more.tokens.insert(absl::AsciiStrToLower(options.token));
  if (more == Revocations()) {
    return absl::InvalidArgumentError(
        "give a name, or --serial and a certificate's number, or --token and a join token's");
  }
  ORBWEAVE_RETURN_IF_ERROR(Revoke(options.store, more));
  std::printf(
      "revoked; a coordinator heeds it from the next call on: where its --tls folder is another, "
      "copy %s/coordinator/revoked there\n",
      options.store.c_str());
  return absl::OkStatus();
}

using Action = absl::Status (*)(const KeysOptions&);

CLI::App* AddAction(CLI::App& keys,
                    SelectedCommand& selected,
                    const std::shared_ptr<KeysOptions>& options,
                    const std::string& name,
                    const std::string& help,
                    Action action) {
  CLI::App* command = keys.add_subcommand(name, help);
  command->add_option("KEYS", options->store, "Folder of the fleet's keys")->required();
  command->callback([options, &selected, action] {
    selected.run = [options, action] { return ReportStatus(action(*options)); };
  });
  return command;
}

void AddHosts(CLI::App& command, KeysOptions& options) {
  command
      .add_option("--host",
                  options.hosts,
                  "Name or address by which others reach the coordinator (repeatable); this "
                  "machine's name and the loopback addresses are always in")
      ->allow_extra_args(false);
}

}  // namespace

void AddKeysCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* keys = app.add_subcommand("keys", "Make the certificates and tokens of a fleet");
  keys->require_subcommand(1);
  const auto options = std::make_shared<KeysOptions>();
  CLI::App* init = AddAction(*keys,
                             selected,
                             options,
                             "init",
                             "Make an authority, and keys of coordinator, client, admin",
                             Init);
  init->add_option("--fleet", options->fleet, "Name of the fleet")->required();
  AddHosts(*init, *options);
  CLI::App* add =
      AddAction(*keys, selected, options, "add", "Make the keys of one more participant", Add);
  add->add_option("ROLE", options->role, "coordinator, worker, client or admin")->required();
  add->add_option("NAME", options->name, "Its name, and that of its folder in KEYS")->required();
  add->add_option("--days", options->days, "How long its certificate is valid")
      ->check(CLI::Range(1, 3650))
      ->capture_default_str();
  AddHosts(*add, *options);
  CLI::App* revoke = AddAction(*keys,
                               selected,
                               options,
                               "revoke",
                               "Shut a participant out, or a join token, for good",
                               Shut);
  revoke->add_option("NAME", options->name, "Its name, whatever certificate it shows");
  revoke->add_option(
      "--serial", options->serial, "Of a single certificate, as 'openssl x509 -serial' prints it");
  revoke->add_option("--token",
                     options->token,
                     "Of a join token that was not used yet, as 'orbweave keys token' prints it");
  CLI::App* token = AddAction(
      *keys, selected, options, "token", "Make a token by which new workers may join", Token);
  token->add_option("--output", options->token_path, "File to write it to (mode 0600)")->required();
  token->add_option("--minutes", options->minutes, "How long it is valid")
      ->check(CLI::Range(0.01, 43200.0))
      ->capture_default_str();
  token
      ->add_option("--uses",
                   options->uses,
                   "How many workers may join by it, each with a key and a name of its own")
      ->check(CLI::Range(uint32_t{1}, kMostUses))
      ->capture_default_str();
  keys->footer(
      "Examples:\n"
      "  orbweave keys init keys --fleet city --host coordinator.example\n"
      "  orbweave keys add keys worker node7\n"
      "  orbweave keys token keys --output join.token --uses 64\n"
      "  orbweave keys revoke keys node7");
}

}  // namespace orbweave
