// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace orbweave {

enum class FaultSide : unsigned char { kBefore, kAfter };

/// A moment at which a crash is tried: where ORBWEAVE_FAULT=result.before:3 is set for the process,
/// it ends as by SIGKILL when it passes kBefore of "result" for the third time. Costs a comparison
/// otherwise. A variable of another form breaks a promise (ORBWEAVE_CHECK); a name that nobody
/// passes does nothing. Thread-safe.
///
/// | point  | between before and after                                                     |
/// |--------|------------------------------------------------------------------------------|
/// | job    | a job, or how it ended, is committed                                         |
/// | start  | an attempt is committed                                                      |
/// | result | a result is committed                                                        |
/// | ends   | ends of attempts without a result are committed                              |
/// | commit | a transaction, all of its statements done (of any of the above)              |
/// | stage  | a stage that was prepared begins                                             |
/// | rename | a file that was written and flushed (blob, link, used token) gets its name   |
/// | get    | a blob is read                                                               |
void FaultPoint(std::string_view point, FaultSide side);

}  // namespace orbweave
