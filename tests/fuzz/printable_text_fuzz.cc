// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>

#include "core/io/page/html_text.h"
#include "core/io/printable_text.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(printable_text) {
  const std::string printable = orbweave::PrintableText(orbweave::BytesOf(data, size));
  ORBWEAVE_CHECK(orbweave::PrintableText(printable) == printable);
  ORBWEAVE_CHECK(std::all_of(printable.begin(), printable.end(), [](char c) {
    return c != '\x7f' && (static_cast<unsigned char>(c) >= 0x20);
  }));
  const std::string html = orbweave::EscapeHtml(orbweave::BytesOf(data, size));
  ORBWEAVE_CHECK(html.find_first_of("<>\"'\x1b") == std::string::npos);
}
