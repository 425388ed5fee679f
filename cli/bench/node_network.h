// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/scaling/job_measurement.h"
#include "core/base/status.h"
#include "worker/child_process.h"

namespace orbweave {

/// What each node of a NodeNetwork is given.
struct NodeLimits {
  double processors = 1.0;    ///< that all its processes may use together
  double link_mbit = 1000.0;  ///< of its link, each way
};

/// Machines on this machine, as root: a hub and nodes beside it, each a network namespace; nodes
/// have a control group that limits their processors and a link to the hub that `tc tbf` limits.
/// All of it goes with this object.
class NodeNetwork {
 public:
  /// FailedPrecondition: this machine or this user cannot have them, and why.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<NodeNetwork>> Make(uint32_t nodes,
                                                                         const NodeLimits& limits);
  ~NodeNetwork();
  NodeNetwork(const NodeNetwork&) = delete;
  NodeNetwork& operator=(const NodeNetwork&) = delete;

  /// The hub's address.
  [[nodiscard]] static std::string HubAddress();
  /// Starts this program on the hub.
  [[nodiscard]] absl::StatusOr<ChildProcess> StartOnHub(const std::vector<std::string>& arguments,
                                                        const std::string& log_path) const;
  /// Starts it on node `number` (from 1), within its limits.
  [[nodiscard]] absl::StatusOr<ChildProcess> StartOnNode(uint32_t number,
                                                         const std::vector<std::string>& arguments,
                                                         const std::string& log_path) const;
  /// What has gone over the link of node `number` since it is there.
  [[nodiscard]] absl::StatusOr<LinkTraffic> TrafficOf(uint32_t number) const;

 private:
  NodeNetwork() = default;
  [[nodiscard]] absl::Status MakeHub();
  [[nodiscard]] absl::Status MakeNode(uint32_t number, const NodeLimits& limits);
  [[nodiscard]] absl::Status MakeGroup(uint32_t number, double processors);
  [[nodiscard]] std::string NamespaceOf(uint32_t number) const;  ///< 0: the hub's
  [[nodiscard]] std::string GroupOf(uint32_t number) const;
  /// `act` by a thread that is in the namespace; so are the processes that it starts.
  [[nodiscard]] absl::Status Within(uint32_t number,
                                    const std::function<absl::Status()>& act) const;

  uint32_t nodes_ = 0;
  std::string groups_;  ///< folder of control groups
};

/// The bytes that came and went by `interface`, as /proc/net/dev tells them. NotFound: it has none
/// of that name.
[[nodiscard]] absl::StatusOr<LinkTraffic> ParseTraffic(const std::string& proc_net_dev,
                                                       const std::string& interface);

}  // namespace orbweave
