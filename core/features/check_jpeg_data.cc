// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/features/check_jpeg_data.h"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

// After <cstdio>: the header uses FILE and size_t and includes nothing.
#include <jerror.h>
#include <jpeglib.h>

namespace orbweave {
namespace {

/// Cameras and drivers fill up the data of a picture, mostly to a multiple of their block; whoever
/// lost his place in the data leaves much more behind.
constexpr double kLargestShareOfExtraneousBytes = 0.01;

/// libjpeg's way out of an error, and what it complained of first.
struct JpegJudge {
  jpeg_error_mgr manager{};  ///< first: libjpeg knows this address alone
  std::jmp_buf stop{};
  size_t num_bytes = 0;
  size_t num_extraneous = 0;
  char problem[JMSG_LENGTH_MAX] = {};
};

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

/// Decodes every block into one row of scratch. Owns nothing itself: errors jump over it.
void DecodeAllRows(jpeg_decompress_struct& codec, std::vector<JSAMPLE>& row) {
  jpeg_read_header(&codec, TRUE);
  codec.scale_num = 1;
  codec.scale_denom = 8;
  codec.dct_method = JDCT_IFAST;
  codec.do_fancy_upsampling = FALSE;
  codec.out_color_space = codec.jpeg_color_space;
  jpeg_start_decompress(&codec);
  row.resize(size_t{codec.output_width} * static_cast<size_t>(codec.output_components));
  JSAMPROW rows[1] = {row.data()};
  while (codec.output_scanline < codec.output_height) jpeg_read_scanlines(&codec, rows, 1);
  jpeg_finish_decompress(&codec);
}

}  // namespace

absl::Status CheckJpegData(std::string_view encoded) {
  JpegJudge judge;
  judge.num_bytes = encoded.size();
  std::vector<JSAMPLE> row;
  jpeg_decompress_struct codec{};
  codec.err = jpeg_std_error(&judge.manager);
  judge.manager.error_exit = StopAtError;
  judge.manager.emit_message = JudgeMessage;
  judge.manager.output_message = StaySilent;
  if (setjmp(judge.stop) == 0) {
    jpeg_create_decompress(&codec);
    jpeg_mem_src(&codec, reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size());
    DecodeAllRows(codec, row);
  }
  jpeg_destroy_decompress(&codec);
  if (judge.problem[0] == '\0') return absl::OkStatus();
  return absl::InvalidArgumentError("the data are damaged (" + std::string(judge.problem) + ")");
}

}  // namespace orbweave
