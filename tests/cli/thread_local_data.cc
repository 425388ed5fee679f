// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A library that, loaded with a program, takes as much of the stack of each of its threads as
// OpenBLAS does.

extern "C" {
thread_local char orbweave_thread_local_data[125'000] = {};
}
