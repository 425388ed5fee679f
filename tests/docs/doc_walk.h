// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/docs/doc_text.h"
#include "tests/support/command.h"

namespace orbweave::docs {

/// What a reader does besides what a document says, before a command that begins so, or after it.
struct Aside {
  std::string command{};
  std::function<void()> before{};
  std::function<void()> after{};
};

/// A command that is not followed as it stands.
struct Elsewhere {
  std::string command{};  ///< how it begins
  std::string reason{};
  std::string instead{};  ///< what is run in its place; empty: nothing
};

/// Follows a document command by command in a folder of its own, with the program that is tested.
/// Addresses, names and numbers of the document stand for others here.
class DocWalk {
 public:
  DocWalk();
  /// Ends what still runs; services end with 0 or, stopped by an engine, 75.
  ~DocWalk();
  DocWalk(const DocWalk&) = delete;
  DocWalk& operator=(const DocWalk&) = delete;

  /// From now on `word` of the document is `meaning` here. Earlier words are replaced first.
  void Means(const std::string& word, const std::string& meaning);
  /// Runs a command to its end. What it prints; the test fails unless it ends with 0.
  std::string Run(const std::string& command);
  /// Starts a service, which writes to NAME.log, and waits until it is there.
  void Start(const std::string& command);
  /// Waits until a service ended by itself, and for its exit code.
  void ExpectEnd(const std::string& name, int exit_code);
  /// A service that runs.
  [[nodiscard]] const testing::Command& At(const std::string& name) const;
  /// Every command of the document in order, but for those that are marked; fails where one of
  /// these is not in `elsewhere`, and where something of `elsewhere` or an aside belongs to no
  /// command.
  void Follow(const std::string& path,
              const std::vector<Aside>& asides,
              const std::vector<Elsewhere>& elsewhere);
  /// In the folder.
  [[nodiscard]] std::string operator/(const std::string& name) const { return folder_ / name; }

 private:
  struct Service {
    std::string name{};
    bool is_worker = false;
    std::unique_ptr<testing::Command> process{};
  };

  [[nodiscard]] std::string Here(std::string command) const;
  [[nodiscard]] std::vector<std::string> InShell(const std::string& command) const;
  /// How often the coordinators said that a worker joined.
  [[nodiscard]] size_t CountJoined() const;
  void FollowOne(const DocCommand& command);

  testing::TemporaryFolder folder_;
  std::vector<std::pair<std::string, std::string>> meanings_;
  std::vector<Service> services_;
  int started_ = 0;
};

/// A port of 127.0.0.1 that was free a moment ago.
[[nodiscard]] std::string FreePort();

}  // namespace orbweave::docs
