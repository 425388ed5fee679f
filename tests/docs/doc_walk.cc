// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/docs/doc_walk.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

namespace orbweave::docs {
namespace {

using testing::Command;
using testing::CommandOutcome;
using testing::ReadAll;
using testing::WaitUntil;

constexpr double kPatience_s = 60.0;

bool IsService(const std::string& command) {
  const std::vector<std::string> words = WordsOf(command);
  return words.size() > 1 && words[0] == "orbweave" && (words[1] == "serve" || words[1] == "work");
}

/// What follows an option; empty: it is not given.
std::string ValueOf(const std::string& command, const std::string& option) {
  const std::vector<std::string> words = WordsOf(command);
  const auto found = std::ranges::find(words, option);
  return found == words.end() || found + 1 == words.end() ? "" : *(found + 1);
}

template <typename List>
auto FindFor(List& list, const std::string& command) {
  return std::ranges::find_if(list,
                              [&](const auto& item) { return command.starts_with(item.command); });
}

}  // namespace

std::string FreePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof at;
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&at), size) == 0)
    ::getsockname(socket, reinterpret_cast<sockaddr*>(&at), &size);
  ::close(socket);
  return std::to_string(ntohs(at.sin_port));
}

DocWalk::DocWalk() {
  std::filesystem::create_directory(folder_ / "bin");
  std::filesystem::create_symlink(ORBWEAVE_BINARY, folder_ / "bin/orbweave");
}

DocWalk::~DocWalk() {
  for (Service& service : services_) {
    if (!service.process) continue;
    service.process->Signal(SIGTERM);
    const CommandOutcome outcome = service.process->Wait();
    EXPECT_EQ(outcome.exit_code, service.is_worker ? 75 : 0)
        << service.name << ": " << ReadAll(folder_ / (service.name + ".log"));
  }
}

void DocWalk::Means(const std::string& word, const std::string& meaning) {
  const auto known =
      std::ranges::find(meanings_, word, &std::pair<std::string, std::string>::first);
  if (known != meanings_.end()) {
    known->second = meaning;
  } else {
    meanings_.emplace_back(word, meaning);
  }
}

std::string DocWalk::Here(std::string command) const {
  for (const auto& [word, meaning] : meanings_) {
    for (size_t at = command.find(word); at != std::string::npos;
         at = command.find(word, at + meaning.size()))
      command.replace(at, word.size(), meaning);
  }
  return command;
}

std::vector<std::string> DocWalk::InShell(const std::string& command) const {
  return {"/bin/bash",
          "-c",
          "set -o pipefail; cd '" + folder_.Path() + "' && PATH=\"$PWD/bin:$PATH\" && " + command};
}

std::string DocWalk::Run(const std::string& command) {
  const std::string here = Here(command);
  std::vector<std::string> words = InShell("exec timeout 90 bash -o pipefail -c \"$0\"");
  words.push_back(here);
  const CommandOutcome outcome = testing::RunCommand(words);
  EXPECT_EQ(outcome.exit_code, 0) << here << "\n" << outcome.out << outcome.err;
  return outcome.out;
}

size_t DocWalk::CountJoined() const {
  const std::string event = "\"event\":\"worker_joined\"";
  size_t count = 0;
  for (const Service& service : services_) {
    const std::string log = ReadAll(folder_ / (service.name + ".log"));
    for (size_t at = log.find(event); at != std::string::npos; at = log.find(event, at + 1))
      ++count;
  }
  return count;
}

void DocWalk::Start(const std::string& command) {
  const std::string here = Here(command);
  const bool is_worker = WordsOf(here).at(1) == "work";
  std::string name = ValueOf(here, "--name");
  if (name.empty()) name = (is_worker ? "worker" : "serve") + std::to_string(++started_);
  std::ranges::replace(name, '/', '_');
  const std::string log = folder_ / (name + ".log");
  const size_t joined = CountJoined();
  services_.push_back(
      {name, is_worker, std::make_unique<Command>(InShell("exec " + here + " 2>'" + log + "'"))});
  const Command& process = *services_.back().process;
  const auto is_there = [&] {
    const bool is_ready = is_worker
                              ? CountJoined() > joined
                              : ReadAll(log).find("\"coordinator_ready\"") != std::string::npos;
    return is_ready || !process.Running();
  };
  EXPECT_TRUE(WaitUntil(is_there, kPatience_s) && process.Running()) << here << "\n"
                                                                     << ReadAll(log);
}

const Command& DocWalk::At(const std::string& name) const {
  const auto found = std::ranges::find(services_, name, &Service::name);
  if (found == services_.end() || !found->process) throw std::logic_error(name + " does not run");
  return *found->process;
}

void DocWalk::ExpectEnd(const std::string& name, int exit_code) {
  const auto found = std::ranges::find_if(services_, [&](const Service& service) {
    return service.name == name && service.process != nullptr;
  });
  ASSERT_NE(found, services_.end()) << name << " does not run";
  EXPECT_TRUE(WaitUntil([&] { return !found->process->Running(); }, kPatience_s)) << name;
  if (found->process->Running()) return;
  EXPECT_EQ(found->process->Wait().exit_code, exit_code) << ReadAll(folder_ / (name + ".log"));
  found->process.reset();
}

void DocWalk::FollowOne(const DocCommand& command) {
  if (IsService(command.text)) {
    Start(command.text);
  } else {
    (void)Run(command.text);
  }
}

void DocWalk::Follow(const std::string& path,
                     const std::vector<Aside>& asides,
                     const std::vector<Elsewhere>& elsewhere) {
  std::set<std::string> used;
  for (const DocCommand& command : CommandsOf(ReadAll(path))) {
    SCOPED_TRACE(path + ":" + std::to_string(command.line) + ": " + command.text);
    if (command.is_elsewhere) {
      const auto listed = FindFor(elsewhere, command.text);
      ASSERT_NE(listed, elsewhere.end()) << "is marked in the document and not listed in the test";
      used.insert(listed->command);
      EXPECT_FALSE(listed->reason.empty());
      if (!listed->instead.empty()) (void)Run(listed->instead);
      continue;
    }
    const auto aside = FindFor(asides, command.text);
    if (aside != asides.end()) used.insert(aside->command);
    if (aside != asides.end() && aside->before) aside->before();
    FollowOne(command);
    if (aside != asides.end() && aside->after) aside->after();
    if (::testing::Test::HasFailure()) return;  // what follows counts on it
  }
  for (const Aside& aside : asides) EXPECT_TRUE(used.contains(aside.command)) << aside.command;
  for (const Elsewhere& listed_one : elsewhere)
    EXPECT_TRUE(used.contains(listed_one.command)) << listed_one.command;
}

}  // namespace orbweave::docs
