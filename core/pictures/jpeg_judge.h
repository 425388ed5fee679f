// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstdio>

// After <cstdio>: the header uses FILE and size_t and includes nothing.
#include <jerror.h>
#include <jpeglib.h>

namespace orbweave {

/// libjpeg's way out of an error, and what it complained of first. Its decoder paints what is
/// damaged or missing in grey or noise, however whole the file looks, and leaves a warning: data
/// that end early, codes that do not exist, lost restart markers, more than a hundredth of the file
/// that belongs to nothing. Remarks on what does not change pixels (a few bytes too many, an
/// unknown version) pass.
struct JpegJudge {
  jpeg_error_mgr manager{};  ///< first: libjpeg knows this address alone
  std::jmp_buf stop{};
  size_t num_bytes = 0;
  size_t num_extraneous = 0;
  char problem[JMSG_LENGTH_MAX] = {};
};

/// Makes `judge` the codec's manager of errors; `num_bytes` are those of the whole file. An error
/// jumps to `judge.stop`, which the caller has set.
void SetJudge(j_common_ptr codec, size_t num_bytes, JpegJudge& judge);

}  // namespace orbweave
