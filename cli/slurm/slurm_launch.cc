// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/slurm/slurm_launch.h"

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "absl/strings/str_cat.h"
#include "cli/process/exit_code.h"
#include "core/io/file.h"
#include "core/storage/durable_file.h"
#include "security/join_token.h"
#include "security/key_store.h"
#include "security/unix_time.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// Keys of a fleet of this job's own, and a token by which its workers join.
absl::Status MakeKeys(const SlurmLaunch& launch) {
  constexpr int64_t kValid_s = int64_t{30} * 86'400;
  const std::string keys = launch.Folder() + "/keys";
  std::error_code error;
  if (!fs::exists(keys, error))
    ORBWEAVE_RETURN_IF_ERROR(MakeKeyStore(keys, "launch", {}, UnixNow()));
  return WriteJoinToken(keys, launch.Folder() + "/join.token", UnixNow() + kValid_s, kMostUses)
      .status();
}

}  // namespace

absl::Status MakeAbsolute(SlurmLaunch& launch) {
  std::error_code error;
  launch.program = fs::read_symlink("/proc/self/exe", error).string();
  launch.work_folder = fs::current_path(error).string();
  launch.output = fs::absolute(launch.output, error).lexically_normal().string();
  while (launch.output.size() > 1 && launch.output.ends_with('/')) launch.output.pop_back();
  if (error) return absl::InvalidArgumentError(absl::StrCat(launch.output, ": ", error.message()));
  launch.name = NameInQueue(fs::path(launch.output).filename().string());
  return absl::OkStatus();
}

absl::Status WriteLaunch(const SlurmLaunch& launch) {
  const std::string folder = launch.Folder();
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(launch.output));
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder));
  ORBWEAVE_RETURN_IF_ERROR(MakeKeys(launch));
  ORBWEAVE_RETURN_IF_ERROR(
      WriteFileDurably(folder, folder + "/coordinator.sbatch", CoordinatorScript(launch)));
  return WriteFileDurably(folder, folder + "/workers.sbatch", WorkersScript(launch));
}

int SubmitLaunch(const SlurmLaunch& launch, SubmitAnd then) {
  std::fflush(nullptr);
  const std::string script = launch.Folder() + "/coordinator.sbatch";
  const std::string command =
      absl::StrCat("exec sbatch ", then == SubmitAnd::kWait ? "--wait " : "", ShellWord(script));
  const int end = std::system(command.c_str());
  if (end != -1 && WIFEXITED(end)) return WEXITSTATUS(end);
  return kExitFailed;
}

}  // namespace orbweave
