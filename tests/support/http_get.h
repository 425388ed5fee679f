// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/support/tcp_talk.h"

namespace orbweave::testing {

/// What the HTTP server at `address` (127.0.0.1:port) answers to GET `path`, headers and all; empty
/// when nobody answers.
inline std::string HttpGet(const std::string& address, const std::string& path) {
  TcpTalk talk(address);
  talk.Say("GET " + path + " HTTP/1.1\r\nHost: " + address + "\r\nConnection: close\r\n\r\n");
  return talk.HearAll();
}

}  // namespace orbweave::testing
