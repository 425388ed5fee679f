// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/architecture/components.h"

#include <deque>
#include <set>

#include "tests/architecture/layers.h"

namespace orbweave::architecture {
namespace {

std::string WithoutEnding(const std::string& path) { return path.substr(0, path.rfind('.')); }

/// The component that a file belongs to.
std::string ComponentOf(const std::string& path, const std::set<std::string>& headers) {
  const std::string name = WithoutEnding(path);
  const size_t file = name.rfind('/') + 1;
  for (size_t end = name.size(); end != std::string::npos && end > file;
       end = name.rfind('_', end - 1)) {
    if (headers.contains(name.substr(0, end) + ".h")) return name.substr(0, end);
  }
  return name;
}

/// Takes away, again and again, what includes nothing that is left: circles stay, and what includes
/// them.
ComponentGraph WithoutEnds(ComponentGraph graph) {
  for (bool is_done = false; !is_done;) {
    std::set<std::string> ends;
    for (const auto& [name, included] : graph) {
      if (included.empty()) ends.insert(name);
    }
    for (const std::string& end : ends) graph.erase(end);
    for (auto& [name, included] : graph)
      std::erase_if(included, [&](const auto& line) { return ends.contains(line.first); });
    is_done = ends.empty();
  }
  return graph;
}

/// Every component that `start` reaches, by the one through which a shortest way reaches it first;
/// `start` itself where a circle leads back.
std::map<std::string, std::string> WaysFrom(const ComponentGraph& graph, const std::string& start) {
  std::map<std::string, std::string> from;
  std::deque<std::string> queue = {start};
  while (!queue.empty()) {
    const std::string name = queue.front();
    queue.pop_front();
    for (const auto& [next, line] : graph.at(name)) {
      if (from.emplace(next, name).second) queue.push_back(next);
    }
  }
  return from;
}

std::string TellCircle(const ComponentGraph& graph,
                       const std::map<std::string, std::string>& from,
                       const std::string& start) {
  std::string told;
  std::string to = start;
  do {
    const std::string& name = from.at(to);
    const std::string step = name + " -> " + to + " (" + graph.at(name).at(to) + ")";
    told = told.empty() ? step : step + ", " + told;
    to = name;
  } while (to != start);
  return told;
}

}  // namespace

ComponentGraph FindComponents(const std::vector<SourceFile>& files) {
  std::set<std::string> headers;
  std::set<std::string> paths;
  for (const SourceFile& file : files) {
    paths.insert(file.path);
    if (file.path.ends_with(".h")) headers.insert(file.path);
  }
  ComponentGraph graph;
  for (const SourceFile& file : files) {
    const std::string name = ComponentOf(file.path, headers);
    std::map<std::string, std::string>& included = graph[name];
    for (const Include& include : FindIncludes(file.text)) {
      if (!paths.contains(include.target)) continue;
      const std::string target = ComponentOf(include.target, headers);
      if (target != name) included.emplace(target, file.path + ":" + std::to_string(include.line));
    }
  }
  return graph;
}

std::vector<std::string> FindCycles(const ComponentGraph& graph) {
  const ComponentGraph rest = WithoutEnds(graph);
  std::vector<std::string> cycles;
  std::set<std::string> told;
  for (const auto& [name, included] : rest) {
    if (told.contains(name)) continue;
    const std::map<std::string, std::string> from = WaysFrom(rest, name);
    if (!from.contains(name)) continue;
    cycles.push_back(TellCircle(rest, from, name));
    for (const auto& [reached, before] : from) {
      if (WaysFrom(rest, reached).contains(name)) told.insert(reached);
    }
  }
  return cycles;
}

}  // namespace orbweave::architecture
