// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/confine_process.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fstream>

namespace orbweave {
namespace {

#if defined(__x86_64__)
constexpr uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr uint32_t kArchitecture = 0;  // no filter
#endif

constexpr sock_filter Load(uint32_t offset) { return {BPF_LD | BPF_W | BPF_ABS, 0, 0, offset}; }
constexpr sock_filter SkipUnless(uint32_t value, uint8_t count) {
  return {BPF_JMP | BPF_JEQ | BPF_K, 0, count, value};
}
constexpr sock_filter Return(uint32_t what) { return {BPF_RET | BPF_K, 0, 0, what}; }

void ForbidSockets() {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if constexpr (kArchitecture == 0) return;
  std::array<sock_filter, 6> steps = {Load(offsetof(seccomp_data, arch)),
                                      SkipUnless(kArchitecture, 2),
                                      Load(offsetof(seccomp_data, nr)),
                                      SkipUnless(__NR_socket, 1),
                                      Return(SECCOMP_RET_ERRNO | EACCES),
                                      Return(SECCOMP_RET_ALLOW)};
  const sock_fprog program{steps.size(), steps.data()};
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0);
}

}  // namespace

void ConfineProcess(uint64_t memory_bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::signal(SIGINT, SIG_IGN);
  ::signal(SIGTERM, SIG_IGN);
  std::ofstream("/proc/self/oom_score_adj") << "1000";
  if (memory_bytes > 0) {
    const rlimit limit{memory_bytes, memory_bytes};
    ::setrlimit(RLIMIT_DATA, &limit);
  }
  ForbidSockets();
}

}  // namespace orbweave
