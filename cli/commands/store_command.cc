// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/store_command.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments/store_argument.h"
#include "cli/process/exit_code.h"
#include "objects/check_store.h"

namespace orbweave {
namespace {

struct StoreArguments {
  std::string address{};
  std::string keys_path{};
};

absl::Status Check(const StoreArguments& arguments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const S3Address address, ParseS3Address(arguments.address));
  ORBWEAVE_ASSIGN_OR_RETURN(const S3Keys keys, FindS3Keys(arguments.keys_path));
  const std::vector<StoreCheck> checks = CheckStore(
      [&](UnixClock clock) { return S3Store::Make(address, keys, {}, std::move(clock)); });
  int failed = 0;
  for (const StoreCheck& check : checks) {
    const bool is_failed = !check.result.ok() && check.is_needed;
    failed += is_failed ? 1 : 0;
    std::printf("%-50s %s%s%s\n",
                check.what.c_str(),
                check.result.ok() ? "ok" : (is_failed ? "FAILED" : "no"),
                check.result.ok() ? "" : ": ",
                std::string(check.result.message()).c_str());
  }
  if (failed == 0) return absl::OkStatus();
  return absl::InternalError(address.ToText() + " does not do what Orbweave asks of a store");
}

}  // namespace

void AddStoreCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("store", "Look at an object store");
  command->require_subcommand(1);
  CLI::App* check = command->add_subcommand(
      "check", "Try out all that Orbweave asks of an object store, with a few small objects");
  const auto arguments = std::make_shared<StoreArguments>();
  check
      ->add_option(
          "URL",
          arguments->address,
          "s3://BUCKET[/PREFIX][?endpoint=https://HOST[:PORT]][&region=R][&style=path|host]")
      ->required();
  AddStoreKeysArgument(*check, arguments->keys_path);
  check->footer(
      "Examples:\n"
      "  orbweave store check 's3://city-blobs/orbweave?region=eu-central-1'\n"
      "  orbweave store check 's3://blobs?endpoint=https://rgw.example:7480' --store-keys "
      "store.keys\n"
      "Exit codes: 0 all that is needed is there, 1 something is missing, 2 the address or the "
      "keys "
      "are none. 'no' is something that Orbweave gets by without.");
  check->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Check(*arguments)); };
  });
}

}  // namespace orbweave
