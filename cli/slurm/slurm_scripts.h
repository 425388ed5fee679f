// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orbweave {

/// A job for Slurm. All paths are absolute, on storage that all nodes see.
struct SlurmLaunch {
  std::string name{};                          ///< of the jobs in the queue
  std::string program{};                       ///< orbweave
  std::string work_folder{};                   ///< what relative paths in run_arguments begin in
  std::vector<std::string> command = {"run"};  ///< of orbweave; takes a fleet as `run` does
  std::string output{};                        ///< of the command
  std::vector<std::string> run_arguments{};    ///< of the command, but for those of its fleet
  uint32_t min_nodes = 1;                      ///< workers there are always
  uint32_t max_nodes = 1;             ///< workers there are while there is work for so many
  uint32_t cpus = 1;                  ///< of a worker, and so its tasks at a time
  std::string time{};                 ///< of an allocation, as sbatch takes it; empty: the site's
  std::vector<std::string> sbatch{};  ///< further options of sbatch, for all
  std::vector<std::string> coordinator_sbatch{};  ///< for the coordinator alone
  std::vector<std::string> workers_sbatch{};      ///< for the workers: graphics cards, memory
  std::string scratch{};         ///< folder of each node for copies of blobs, in which $NAME is the
                                 ///< node's; empty: none
  std::string scratch_size{};    ///< as `work --scratch-size` takes it; empty: as that says
  std::string journal_folder{};  ///< of the command; empty: where the node has its temporary files

  /// Where the scripts, keys and logs are.
  [[nodiscard]] std::string Folder() const { return output + "/.orbweave/launch"; }
  /// By which this launch's workers are told from all others in the queue.
  [[nodiscard]] std::string WorkersName() const;
  /// Whether large blobs go to an object store, and not to the folder that all nodes see.
  [[nodiscard]] bool HasStore() const;
};

/// The batch script of the coordinator: it submits the workers, runs the job, and requeues itself
/// when its time is up before the job is done. Its exit code is that of the command. Every 30 s it
/// looks which workers are missing, those that wait in the queue counted: of `min_nodes`, or of as
/// many as there is work for (`orbweave status --wanted`), `max_nodes` at most. It submits them,
/// once a minute at most; where Slurm takes none it waits twice as long each time, up to 16
/// minutes. It takes none away: those beyond `min_nodes` leave when they have had nothing to do for
/// two minutes.
[[nodiscard]] std::string CoordinatorScript(const SlurmLaunch& launch);

/// That of the workers, an array of jobs that begin whenever there is room for one, are requeued
/// when their time is up, and end when the coordinator sends them home.
[[nodiscard]] std::string WorkersScript(const SlurmLaunch& launch);

/// The name in the queue of a launch into a folder of this name.
[[nodiscard]] std::string NameInQueue(const std::string& name);

/// `text` as one word of a shell, in which $NAME and ${NAME} are as the shell has them, and nothing
/// else is more than itself.
[[nodiscard]] std::string ShellWordWithNames(const std::string& text);

/// `text` as one word of a shell.
[[nodiscard]] std::string ShellWord(const std::string& text);

}  // namespace orbweave
