// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/bench/node_network.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "core/base/file_descriptor.h"
#include "core/io/file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

constexpr char kNodeLink[] = "eth0";
constexpr int kPeriod_us = 100'000;

/// A command of the system. FailedPrecondition: what it says.
absl::Status RunTool(const std::string& command) {
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "re");
  if (pipe == nullptr) return absl::UnavailableError("cannot start " + command);
  std::string said;
  std::array<char, 512> piece{};
  while (std::fgets(piece.data(), piece.size(), pipe) != nullptr) said += piece.data();
  if (::pclose(pipe) == 0) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat(command, ": ", absl::StripSuffix(said, "\n")));
}

std::string AddressOf(uint32_t number) {
  return absl::StrCat("10.79.", (number + 1) / 256, ".", (number + 1) % 256);
}

/// The folder in which groups that limit processors can be made; v2 and v1 of control groups.
absl::StatusOr<std::string> FindGroups() {
  const std::string v2 = "/sys/fs/cgroup";
  const absl::StatusOr<std::string> controllers = ReadFile(v2 + "/cgroup.controllers");
  if (controllers.ok() && absl::StrContains(*controllers, "cpu")) {
    std::ofstream(v2 + "/cgroup.subtree_control") << "+cpu";
    return v2;
  }
  std::error_code error;
  for (const char* v1 : {"/sys/fs/cgroup/cpu", "/sys/fs/cgroup/cpu,cpuacct"}) {
    if (fs::exists(absl::StrCat(v1, "/cpu.cfs_quota_us"), error)) return v1;
  }
  return absl::FailedPreconditionError(
      "no control groups for processors at /sys/fs/cgroup: netns cannot limit nodes here");
}

absl::Status WriteTo(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  if (file.good()) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat("cannot write ", text, " to ", path, ": ", std::strerror(errno)));
}

}  // namespace

absl::StatusOr<LinkTraffic> ParseTraffic(const std::string& proc_net_dev,
                                         const std::string& interface) {
  for (const absl::string_view line : absl::StrSplit(proc_net_dev, '\n')) {
    const std::vector<std::string> sides = absl::StrSplit(line, absl::MaxSplits(':', 1));
    if (sides.size() != 2 || absl::StripAsciiWhitespace(sides[0]) != interface) continue;
    const std::vector<std::string> counts =
        absl::StrSplit(sides[1], absl::ByAnyChar(" \t"), absl::SkipEmpty());
    LinkTraffic traffic;
    constexpr size_t kOut = 8;
    if (counts.size() > kOut && absl::SimpleAtoi(counts[0], &traffic.in_bytes) &&
        absl::SimpleAtoi(counts[kOut], &traffic.out_bytes))
      return traffic;
  }
  return absl::NotFoundError("there is no interface " + interface);
}

absl::StatusOr<std::unique_ptr<NodeNetwork>> NodeNetwork::Make(uint32_t nodes,
                                                               const NodeLimits& limits) {
  if (::geteuid() != 0)
    return absl::FailedPreconditionError("--engine netns makes network namespaces: run it as root");
  std::unique_ptr<NodeNetwork> network(new NodeNetwork());
  ORBWEAVE_ASSIGN_OR_RETURN(network->groups_, FindGroups());
  ORBWEAVE_RETURN_IF_ERROR(network->MakeHub());
  for (uint32_t number = 1; number <= nodes; ++number)
    ORBWEAVE_RETURN_IF_ERROR(network->MakeNode(number, limits));
  return network;
}

NodeNetwork::~NodeNetwork() {
  for (uint32_t number = 0; number <= nodes_; ++number) {
    (void)RunTool("ip netns delete " + NamespaceOf(number));
    if (number > 0) ::rmdir(GroupOf(number).c_str());
  }
}

std::string NodeNetwork::HubAddress() { return AddressOf(0); }

std::string NodeNetwork::NamespaceOf(uint32_t number) const {
  return absl::StrCat("orbweave-", ::getpid(), "-", number);
}

std::string NodeNetwork::GroupOf(uint32_t number) const {
  return absl::StrCat(groups_, "/", NamespaceOf(number));
}

absl::Status NodeNetwork::MakeHub() {
  const std::string hub = NamespaceOf(0);
  ORBWEAVE_RETURN_IF_ERROR(RunTool("ip netns add " + hub));
  for (const std::string& command : {std::string("link set lo up"),
                                     std::string("link add name bridge type bridge"),
                                     absl::StrCat("address add ", AddressOf(0), "/16 dev bridge"),
                                     std::string("link set bridge up")})
    ORBWEAVE_RETURN_IF_ERROR(RunTool(absl::StrCat("ip -n ", hub, " ", command)));
  return absl::OkStatus();
}

absl::Status NodeNetwork::MakeNode(uint32_t number, const NodeLimits& limits) {
  const std::string hub = NamespaceOf(0);
  const std::string node = NamespaceOf(number);
  const std::string wire = absl::StrCat("wire", number);
  ORBWEAVE_RETURN_IF_ERROR(RunTool("ip netns add " + node));
  nodes_ = number;
  const std::string rate = absl::StrCat(
      " root tbf rate ", std::llround(1e3 * limits.link_mbit), "kbit burst 256kb latency 400ms");
  for (const std::string& command :
       {absl::StrCat("ip -n ",
                     hub,
                     " link add name ",
                     wire,
                     " type veth peer name ",
                     kNodeLink,
                     " netns ",
                     node),
        absl::StrCat("ip -n ", hub, " link set ", wire, " master bridge up"),
        absl::StrCat("ip -n ", node, " address add ", AddressOf(number), "/16 dev ", kNodeLink),
        absl::StrCat("ip -n ", node, " link set lo up"),
        absl::StrCat("ip -n ", node, " link set ", kNodeLink, " up"),
        absl::StrCat("tc -n ", node, " qdisc add dev ", kNodeLink, rate),
        absl::StrCat("tc -n ", hub, " qdisc add dev ", wire, rate)})
    ORBWEAVE_RETURN_IF_ERROR(RunTool(command));
  return MakeGroup(number, limits.processors);
}

absl::Status NodeNetwork::MakeGroup(uint32_t number, double processors) {
  const std::string group = GroupOf(number);
  std::error_code error;
  fs::create_directory(group, error);
  if (error) return absl::FailedPreconditionError(absl::StrCat(group, ": ", error.message()));
  const auto quota_us = std::to_string(std::llround(processors * kPeriod_us));
  if (fs::exists(group + "/cpu.max", error))
    return WriteTo(group + "/cpu.max", absl::StrCat(quota_us, " ", kPeriod_us));
  ORBWEAVE_RETURN_IF_ERROR(WriteTo(group + "/cpu.cfs_period_us", absl::StrCat(kPeriod_us)));
  return WriteTo(group + "/cpu.cfs_quota_us", quota_us);
}

absl::Status NodeNetwork::Within(uint32_t number, const std::function<absl::Status()>& act) const {
  const std::string path = "/run/netns/" + NamespaceOf(number);
  absl::Status status;
  std::thread([&] {
    const FileDescriptor space(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!space.IsOpen() || ::setns(space.get(), CLONE_NEWNET) != 0) {
      status = absl::FailedPreconditionError(absl::StrCat(path, ": ", std::strerror(errno)));
      return;
    }
    status = act();
  }).join();
  return status;
}

absl::StatusOr<ChildProcess> NodeNetwork::StartOnHub(const std::vector<std::string>& arguments,
                                                     const std::string& log_path) const {
  ChildProcess child;
  ORBWEAVE_RETURN_IF_ERROR(Within(0, [&]() -> absl::Status {
    ORBWEAVE_ASSIGN_OR_RETURN(child, ChildProcess::SpawnSelf(arguments, {.log_path = log_path}));
    return absl::OkStatus();
  }));
  return child;
}

absl::StatusOr<ChildProcess> NodeNetwork::StartOnNode(uint32_t number,
                                                      const std::vector<std::string>& arguments,
                                                      const std::string& log_path) const {
  ChildProcess child;
  ORBWEAVE_RETURN_IF_ERROR(Within(number, [&]() -> absl::Status {
    ORBWEAVE_ASSIGN_OR_RETURN(child, ChildProcess::SpawnSelf(arguments, {.log_path = log_path}));
    return WriteTo(GroupOf(number) + "/cgroup.procs", absl::StrCat(child.pid()));
  }));
  return child;
}

absl::StatusOr<LinkTraffic> NodeNetwork::TrafficOf(uint32_t number) const {
  LinkTraffic traffic;
  ORBWEAVE_RETURN_IF_ERROR(Within(number, [&]() -> absl::Status {
    std::ostringstream text;
    text << std::ifstream("/proc/thread-self/net/dev").rdbuf();
    ORBWEAVE_ASSIGN_OR_RETURN(traffic, ParseTraffic(text.str(), kNodeLink));
    return absl::OkStatus();
  }));
  traffic.node = absl::StrCat("node ", number);
  return traffic;
}

}  // namespace orbweave
