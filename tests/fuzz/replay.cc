// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// replay TARGET CORPUS: runs a fuzz target, without a fuzzer, on the files of its corpus and on
// damaged copies of them: cut off at every length, one byte after the other changed. Of large files
// evenly spread places are taken. An allocation out of proportion to the input ends the process.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

namespace {

constexpr size_t kMostPlaces = 256;

/// Of a single allocation; see AllowFor.
std::atomic<size_t> allowed_bytes = std::numeric_limits<size_t>::max();

void AllowFor(size_t input_bytes) { allowed_bytes = (size_t{16} << 20) + 1024 * input_bytes; }

void Try(orbweave::FuzzTarget target, const std::string& input) {
  // Exactly as large as the input, so that a sanitizer sees a read beyond its end.
  const std::vector<uint8_t> bytes(input.begin(), input.end());
  AllowFor(bytes.size());
  target(bytes.data(), bytes.size());
}

/// All places of `size` bytes, or as many as are tried, evenly spread.
std::vector<size_t> Places(size_t size) {
  std::vector<size_t> places(std::min(size, kMostPlaces));
  for (size_t i = 0; i < places.size(); ++i) places[i] = i * size / places.size();
  return places;
}

void TryDamaged(orbweave::FuzzTarget target, const std::string& input) {
  for (const size_t length : Places(input.size())) Try(target, input.substr(0, length));
  for (const size_t at : Places(input.size())) {
    for (const unsigned char change : {0x01, 0x80, 0xff}) {
      std::string changed = input;
      changed[at] = static_cast<char>(static_cast<unsigned char>(changed[at]) ^ change);
      Try(target, changed);
    }
  }
}

std::string ReadBytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

void* operator new(size_t size) {
  if (size > allowed_bytes) {
    std::fprintf(
        stderr, "an allocation of %zu bytes, %zu are allowed\n", size, allowed_bytes.load());
    std::abort();
  }
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }

int main(int argc, char** argv) {
  const auto& targets = orbweave::FuzzTargets();
  const auto target = argc == 3 ? targets.find(argv[1]) : targets.end();
  if (target == targets.end()) {
    std::fprintf(stderr, "replay TARGET CORPUS, one of %zu targets\n", targets.size());
    return 1;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[2]))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Try(target->second, "");
  for (const std::filesystem::path& file : files) {
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);
    const std::string input = ReadBytes(file);
    Try(target->second, input);
    TryDamaged(target->second, input);
  }
  return files.empty() ? 1 : 0;
}
