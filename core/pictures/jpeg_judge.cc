// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pictures/jpeg_judge.h"

namespace orbweave {
namespace {

/// Cameras and drivers fill up the data of a picture, mostly to a multiple of their block; whoever
/// lost his place in the data leaves much more behind.
constexpr double kLargestShareOfExtraneousBytes = 0.01;

JpegJudge& JudgeOf(j_common_ptr codec) { return *reinterpret_cast<JpegJudge*>(codec->err); }

void Complain(j_common_ptr codec) {
  JpegJudge& judge = JudgeOf(codec);
  if (judge.problem[0] == '\0') judge.manager.format_message(codec, judge.problem);
}

[[noreturn]] void StopAtError(j_common_ptr codec) {
  Complain(codec);
  std::longjmp(JudgeOf(codec).stop, 1);
}

/// Called with level -1 for warnings, 0 and more for traces.
void JudgeMessage(j_common_ptr codec, int level) {
  if (level >= 0) return;
  JpegJudge& judge = JudgeOf(codec);
  switch (judge.manager.msg_code) {
    case JWRN_EXTRANEOUS_DATA:
      judge.num_extraneous += static_cast<size_t>(judge.manager.msg_parm.i[0]);
      if (static_cast<double>(judge.num_extraneous) >
          kLargestShareOfExtraneousBytes * static_cast<double>(judge.num_bytes))
        Complain(codec);
      break;
    case JWRN_ADOBE_XFORM:
    case JWRN_JFIF_MAJOR:
    case JWRN_NOT_SEQUENTIAL:
      break;
    default:
      Complain(codec);
  }
}

void StaySilent(j_common_ptr /*codec*/) {}

}  // namespace

void SetJudge(j_common_ptr codec, size_t num_bytes, JpegJudge& judge) {
  codec->err = jpeg_std_error(&judge.manager);
  judge.num_bytes = num_bytes;
  judge.manager.error_exit = StopAtError;
  judge.manager.emit_message = JudgeMessage;
  judge.manager.output_message = StaySilent;
}

}  // namespace orbweave
