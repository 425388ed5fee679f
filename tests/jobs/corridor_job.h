// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/io/sqlite_connection.h"
#include "tests/support/command.h"

/// A small job that runs in seconds: a corridor of rays, divided into several clusters.

namespace orbweave::testing {

/// Writes corridor.db, gnss.csv and truth.csv once per test program.
inline const std::string& CorridorFolder() {
  static const TemporaryFolder folder;
  static const std::string path = [] {
    const CommandOutcome made = RunCommand(
        {ORBWEAVE_BINARY, "synth", "corridor", "--panoramas", "60", "--output", folder.Path()});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder.Path();
  }();
  return path;
}

inline std::vector<std::string> ReconstructCorridor(const std::string& output, int workers) {
  return {ORBWEAVE_BINARY,
          "reconstruct",
          "--database",
          CorridorFolder() + "/corridor.db",
          "--gnss",
          CorridorFolder() + "/gnss.csv",
          "--output",
          output,
          "--workers",
          std::to_string(workers),
          "--set",
          "partition.cluster_size=16"};
}

/// Results in a journal that may be written to.
inline size_t FinishedTasksIn(const std::string& journal) {
  if (!std::filesystem::exists(journal)) return 0;
  const auto database = SqliteConnection::OpenToRead(journal);
  if (!database.ok()) return 0;
  auto count = database->Prepare("SELECT COUNT(*) FROM orbweave_result");
  if (!count.ok() || !count->Step().ok()) return 0;
  return static_cast<size_t>(count->Integer(0));
}

/// Results of a job that may be running.
inline size_t FinishedTasks(const std::string& output) {
  return FinishedTasksIn(output + "/.orbweave/journal.db");
}

inline nlohmann::json ReportOf(const std::string& output) {
  return nlohmann::json::parse(ReadAll(output + "/report.json"), nullptr, false);
}

/// Sum over stages of `key`: "tasks_reused" or "tasks_computed".
inline uint32_t SumOverStages(const std::string& output, const char* key) {
  const nlohmann::json report = ReportOf(output);
  EXPECT_FALSE(report["stages"].empty());
  uint32_t sum = 0;
  for (const auto& stage : report["stages"]) sum += stage[key].get<uint32_t>();
  return sum;
}

inline uint32_t ReusedTasks(const std::string& output) {
  return SumOverStages(output, "tasks_reused");
}

inline uint32_t ComputedTasks(const std::string& output) {
  return SumOverStages(output, "tasks_computed");
}

inline void ExpectSameFiles(const std::string& a,
                            const std::string& b,
                            const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::string bytes = ReadAll(a + "/" + name);
    EXPECT_FALSE(bytes.empty()) << name;
    EXPECT_TRUE(bytes == ReadAll(b + "/" + name)) << name << " differs";
  }
}

/// The files of a model without georeference that must be the same whoever computed them.
inline void ExpectSameLocalModel(const std::string& a, const std::string& b) {
  ExpectSameFiles(a,
                  b,
                  {"sparse/0/cameras.bin",
                   "sparse/0/images.bin",
                   "sparse/0/points3D.bin",
                   "points.ply",
                   "cameras.csv"});
}

/// The same of a model with one.
inline void ExpectSameModel(const std::string& a, const std::string& b) {
  ExpectSameLocalModel(a, b);
  ExpectSameFiles(a, b, {"trajectory.geojson", "georeference.json"});
}

}  // namespace orbweave::testing
