// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace orbweave {

/// OpenMP, OpenBLAS and OpenCV start threads of their own unless the environment forbids it, and
/// the first two look there before main begins. Sets what is not set and, if that was anything,
/// starts this executable again with `argv`; returns when there was nothing to do. Processes
/// started later inherit it.
void RunLibrariesOnOneThread(char** argv);

}  // namespace orbweave
