// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `relay LISTEN TARGET DELAY_MS`: see DelayingRelay. Runs until SIGTERM, then prints how many
// pieces it held back.

#include <csignal>
#include <cstdio>
#include <thread>

#include "absl/strings/numbers.h"
#include "tests/chaos/delaying_relay.h"

int main(int argc, char** argv) {
  int delay_ms = 0;
  if (argc != 4 || !absl::SimpleAtoi(argv[3], &delay_ms) || delay_ms < 0) {
    std::fprintf(stderr, "usage: relay LISTEN TARGET DELAY_MS\n");
    return 2;
  }
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  auto relay = orbweave::testing::DelayingRelay::Start(
      argv[1], argv[2], std::chrono::milliseconds(delay_ms));
  if (!relay.ok()) {
    std::fprintf(stderr, "relay: %s\n", std::string(relay.status().message()).c_str());
    return 1;
  }
  std::jthread running([&relay](const std::stop_token& stop) { relay->Run(stop); });
  int signal = 0;
  sigwait(&ends, &signal);
  running.request_stop();
  running.join();
  std::printf("%llu\n", static_cast<unsigned long long>(relay->pieces()));
  return 0;
}
