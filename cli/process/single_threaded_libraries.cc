// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/process/single_threaded_libraries.h"

#include <unistd.h>

#include <array>
#include <cstdlib>

namespace orbweave {

void RunLibrariesOnOneThread(char** argv) {
  constexpr std::array<const char*, 3> kNames = {
      "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OPENCV_FOR_THREADS_NUM"};
  bool changed = false;
  for (const char* name : kNames) {
    if (std::getenv(name) != nullptr) continue;
    ::setenv(name, "1", 0);
    changed = true;
  }
  if (changed)
    ::execv("/proc/self/exe", argv);  // going on with more threads is the only other choice
}

}  // namespace orbweave
