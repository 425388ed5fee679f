// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

class SpawnSettings {
 public:
  explicit SpawnSettings(const ChildSettings& settings) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!settings.log_path.empty()) {
      ::posix_spawn_file_actions_addopen(
          &actions_, STDERR_FILENO, settings.log_path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    }
    ::posix_spawn_file_actions_adddup2(&actions_, STDERR_FILENO, STDOUT_FILENO);
    const bool has_channel = settings.channel >= 0;
    if (has_channel)
      ::posix_spawn_file_actions_adddup2(&actions_, settings.channel, kChannelDescriptor);
    ::posix_spawn_file_actions_addclosefrom_np(
        &actions_, has_channel ? kChannelDescriptor + 1 : kChannelDescriptor);
    sigset_t none;
    sigset_t stopping;
    ::sigemptyset(&none);
    ::sigemptyset(&stopping);
    ::sigaddset(&stopping, SIGINT);
    ::sigaddset(&stopping, SIGTERM);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &stopping);
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    ::posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&actions_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  [[nodiscard]] const posix_spawn_file_actions_t* actions() const { return &actions_; }
  [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

std::string DescribeEnd(int status) {
  if (!WIFSIGNALED(status)) return absl::StrCat("exit code ", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  const char* name = ::sigdescr_np(signal);
  return absl::StrCat("signal ", signal, " (", name != nullptr ? name : "unknown", ")");
}

}  // namespace

ChildProcess::~ChildProcess() { Kill(); }

ChildProcess::ChildProcess(ChildProcess&& other) noexcept : pid_(std::exchange(other.pid_, -1)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  return *this;
}

absl::StatusOr<ChildProcess> ChildProcess::SpawnSelf(const std::vector<std::string>& arguments,
                                                     const ChildSettings& child_settings) {
  std::vector<std::string> texts = arguments;
  std::vector<char*> argv;
  for (std::string& text : texts) argv.push_back(text.data());
  argv.push_back(nullptr);
  const SpawnSettings settings(child_settings);
  ChildProcess child;
  const int error = ::posix_spawn(&child.pid_,
                                  "/proc/self/exe",
                                  settings.actions(),
                                  settings.attributes(),
                                  argv.data(),
                                  environ);
  if (error == 0) return child;
  child.pid_ = -1;
  return absl::UnavailableError(
      absl::StrCat("cannot start ", arguments.front(), ": ", std::strerror(error)));
}

void ChildProcess::Signal(int signal) const {
  if (pid_ > 0) ::kill(pid_, signal);
}

double ChildProcess::CpuSeconds() const {
  clockid_t clock{};
  timespec time{};
  if (pid_ <= 0 || ::clock_getcpuclockid(pid_, &clock) != 0) return 0.0;
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::optional<std::string> ChildProcess::PollEnd() {
  int status = 0;
  if (pid_ <= 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  return DescribeEnd(status);
}

std::string ChildProcess::Kill() {
  if (pid_ <= 0) return "nothing";
  int status = 0;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return DescribeEnd(status);
}

}  // namespace orbweave
