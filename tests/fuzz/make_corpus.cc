// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `make_corpus FOLDER`: writes the well-formed inputs of every fuzz target to FOLDER/TARGET/seed_N.

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/seeds.h"
#include "tests/fuzz/temporary_folder.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_corpus FOLDER\n");
    return 2;
  }
  const orbweave::TemporaryFolder folder;
  orbweave::Seeds seeds;
  orbweave::AddArtifactSeeds(seeds);
  orbweave::AddAdjustmentSeeds(seeds);
  orbweave::AddDenseSeeds(seeds);
  orbweave::AddMessageSeeds(seeds);
  orbweave::AddTextSeeds(seeds);
  orbweave::AddImageSeeds(seeds);
  orbweave::AddSecuritySeeds(seeds);
  orbweave::AddFileSeeds(folder.path(), seeds);
  for (const auto& [target, inputs] : seeds) {
    const std::filesystem::path corpus = std::filesystem::path(argv[1]) / target;
    std::filesystem::create_directories(corpus);
    for (size_t i = 0; i < inputs.size(); ++i)
      std::ofstream(corpus / ("seed_" + std::to_string(i)), std::ios::binary) << inputs[i];
  }
  return 0;
}
