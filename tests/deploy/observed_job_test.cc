// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A coordinator of `serve --http --otlp` that runs a job, looked at as deploy/ would have it looked
// at: this executable plays the commands, with the stages of the toy job.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "cli/commands/exec_tasks_command.h"
#include "cli/commands/serve_command.h"
#include "cli/commands/work_command.h"
#include "tests/deploy/named_metrics.h"
#include "tests/support/command.h"
#include "tests/support/command_or_tests.h"
#include "tests/support/http_collector.h"
#include "tests/support/http_get.h"
#include "tests/support/toy_job.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using Json = nlohmann::json;
using testing::Command;
using ::testing::HasSubstr;
using testing::HttpCollector;
using testing::ReadAll;
using testing::WaitUntil;

const std::string kSource = ORBWEAVE_SOURCE_DIR;

std::vector<std::string> Orbweave(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), std::filesystem::read_symlink("/proc/self/exe").string());
  return arguments;
}

/// All expressions of the dashboard, with its variable for any instance.
std::vector<std::string> ExpressionsOfDashboard() {
  std::vector<std::string> expressions;
  const Json dashboard = Json::parse(ReadAll(kSource + "/deploy/grafana/orbweave.json"));
  for (const Json& panel : dashboard.at("panels")) {
    for (const Json& target : panel.at("targets"))
      expressions.push_back(std::regex_replace(
          target.at("expr").get<std::string>(), std::regex(R"(\$instance)"), ""));
  }
  return expressions;
}

/// What stands behind `expr:` in the rules, over as many lines as are indented further.
std::vector<std::string> ExpressionsOfAlerts() {
  std::vector<std::string> expressions;
  std::istringstream rules(ReadAll(kSource + "/deploy/prometheus/alerts.yaml"));
  const std::string key = "        expr: ";
  bool is_inside = false;
  for (std::string line; std::getline(rules, line);) {
    if (line.starts_with(key)) {
      expressions.push_back(line.substr(key.size()));
      is_inside = true;
    } else if (is_inside && line.starts_with("          ")) {
      expressions.back() += line;
    } else {
      is_inside = false;
    }
  }
  return expressions;
}

/// Texts in the coordinator's sources: names of events among them.
bool IsSaidByTheCoordinator(const std::string& event) {
  for (const char* folder : {"/coordinator", "/cli"}) {
    for (const auto& file : std::filesystem::directory_iterator(kSource + folder)) {
      if (file.path().extension() == ".cc" &&
          ReadAll(file.path().string()).find('"' + event + '"') != std::string::npos)
        return true;
    }
  }
  return false;
}

/// A coordinator with a worker of two slots.
class ObservedJob : public ::testing::Test {
 protected:
  void Serve(const std::vector<std::string>& further) {
    std::vector<std::string> words = {
        "serve", "--listen", address_, "--state", folder_ / "state", "--http", "127.0.0.1:0"};
    words.insert(words.end(), further.begin(), further.end());
    serve_ = std::make_unique<Command>(Orbweave(words));
    ASSERT_TRUE(WaitUntil(
        [this] { return serve_->ErrSoFar().find("coordinator_ready") != std::string::npos; }, 60.0))
        << serve_->ErrSoFar();
    const std::string log = serve_->ErrSoFar();
    const size_t begin = log.find("127.0.0.1:", log.find("http_ready"));
    http_ = log.substr(begin, log.find('"', begin) - begin);
    work_ = std::make_unique<Command>(
        Orbweave({"work", "--join", address_, "--name", "w", "--slots", "2"}));
  }
  Digest Submit(const std::string& numbers, const std::string& traceparent = "") {
    GrpcCoordinatorClient client(address_);
    auto job = testing::PrepareToyJob(client, numbers, "toy.pause=true\n");
    EXPECT_TRUE(job.ok()) << job.status();
    job->label = "toy";
    job->traceparent = traceparent;
    const auto id = client.SubmitJob(*job);
    EXPECT_TRUE(id.ok()) << id.status();
    return *id;
  }
  [[nodiscard]] std::map<std::string, deploy::ScrapedMetric> Scrape() const {
    return deploy::ReadScrape(testing::HttpGet(http_, "/metrics"));
  }
  /// What expressions name and a scrape has not.
  static std::vector<std::string> MissingIn(
      const std::map<std::string, deploy::ScrapedMetric>& scrape,
      const std::vector<std::string>& expressions) {
    std::vector<std::string> missing;
    for (const std::string& expression : expressions) {
      std::set<std::string> labels = {"instance"};
      for (const deploy::NamedMetric& wanted : deploy::MetricsNamedIn(expression)) {
        const auto found = scrape.find(wanted.name);
        if (found == scrape.end()) {
          missing.push_back(wanted.name);
          continue;
        }
        for (const auto& [label, values] : found->second.labels) labels.insert(label);
        AddMissing(wanted, found->second, missing);
      }
      for (const std::string& label : deploy::LabelsNamedIn(expression)) {
        if (!labels.contains(label)) missing.push_back("label " + label + " in " + expression);
      }
    }
    return missing;
  }
  static void AddMissing(const deploy::NamedMetric& wanted,
                         const deploy::ScrapedMetric& scraped,
                         std::vector<std::string>& missing) {
    for (const auto& [label, values] : wanted.values) {
      if (label == "instance") continue;
      const auto found = scraped.labels.find(label);
      for (const std::string& value : values) {
        const bool is_there = found != scraped.labels.end() && found->second.contains(value);
        const bool may_come = label == "event" && IsSaidByTheCoordinator(value);
        const bool is_level = label == "level" && (value == "warning" || value == "info");
        if (!is_there && !may_come && !is_level)
          missing.push_back(wanted.name + "{" + label + "=" + value + "}");
      }
    }
  }

  testing::TemporaryFolder folder_;
  std::string address_ = "unix:" + (folder_ / "s");
  std::string http_;
  std::unique_ptr<Command> serve_;
  std::unique_ptr<Command> work_;
};

TEST(NamedMetrics, AreReadFromExpressions) {
  const auto metrics = deploy::MetricsNamedIn(
      R"(sum by (instance, le) (rate(orbweave_a_bucket{x=~"b|c",y!="d"}[5m])) > orbweave_e)");
  ASSERT_EQ(metrics.size(), 2U);
  EXPECT_EQ(metrics[0].name, "orbweave_a_bucket");
  EXPECT_EQ(metrics[0].values.at("x"), (std::vector<std::string>{"b", "c"}));
  EXPECT_EQ(metrics[0].values.at("y"), (std::vector<std::string>{"d"}));
  EXPECT_EQ(metrics[1].name, "orbweave_e");
  EXPECT_EQ(deploy::LabelsNamedIn("sum by (instance, le) (a) and on (b) c"),
            (std::set<std::string>{"b", "instance", "le"}));
}

TEST_F(ObservedJob, HasEveryMetricThatAPanelOrAnAlertNames) {
  Serve({});
  std::vector<std::string> expressions = ExpressionsOfDashboard();
  const std::vector<std::string> alerts = ExpressionsOfAlerts();
  ASSERT_GE(expressions.size(), 15U);
  ASSERT_GE(alerts.size(), 8U);
  expressions.insert(expressions.end(), alerts.begin(), alerts.end());
  for (const std::string& expression : expressions)
    EXPECT_FALSE(deploy::MetricsNamedIn(expression).empty()) << expression;
  std::string numbers;
  for (int i = 0; i < 300; ++i) numbers += std::to_string(i) + " ";
  Submit(numbers);
  (void)testing::HttpGet(http_, "/readyz");  // which saves as well
  std::vector<std::string> missing;
  const auto has_all = [&] {
    missing = MissingIn(Scrape(), expressions);
    return missing.empty();
  };
  EXPECT_TRUE(WaitUntil(has_all, 25.0)) << ::testing::PrintToString(missing);
  EXPECT_FALSE(MissingIn(Scrape(), {"orbweave_no_such_metric"}).empty());
  EXPECT_FALSE(MissingIn(Scrape(), {"orbweave_jobs{state=\"no_such_state\"}"}).empty());
  EXPECT_FALSE(MissingIn(Scrape(), {"sum by (no_such_label) (orbweave_jobs)"}).empty());
}

/// Spans by name, in the order that they came.
std::multimap<std::string, Json> SpansOf(const HttpCollector& collector) {
  std::multimap<std::string, Json> spans;
  for (const std::string& body : collector.Bodies()) {
    const Json request = Json::parse(body);
    for (const Json& resource : request.at("resourceSpans")) {
      for (const Json& span : resource.at("scopeSpans").at(0).at("spans"))
        spans.emplace(span.at("name"), span);
    }
  }
  return spans;
}

TEST_F(ObservedJob, SendsItsSpansToACollector) {
  const HttpCollector collector;
  Serve({"--otlp", collector.Url()});
  const std::string trace = "0af7651916cd43dd8448eb211c80319c";
  const Digest job = Submit("1 2 3", "00-" + trace + "-b7ad6b7169203331-01");
  ASSERT_TRUE(WaitUntil([&] { return SpansOf(collector).contains("job"); }, 60.0))
      << ::testing::PrintToString(collector.Requests()) << serve_->ErrSoFar();
  const auto spans = SpansOf(collector);
  EXPECT_THAT(collector.Requests().at(0), HasSubstr("POST /v1/traces "));
  EXPECT_EQ(spans.count("split task") + spans.count("sum task"), 2U);
  EXPECT_EQ(spans.count("square task"), 3U);
  const Json& root = spans.find("job")->second;
  EXPECT_EQ(root.at("parentSpanId"), "b7ad6b7169203331");
  EXPECT_EQ(root.at("attributes").at(2).at("value").at("stringValue"), job.ToHex());
  for (const auto& [name, span] : spans) EXPECT_EQ(span.at("traceId"), trace) << name;
  for (const char* stage : {"split", "square", "sum"}) {
    ASSERT_EQ(spans.count(stage), 1U) << stage;
    const Json& run = spans.find(stage)->second;
    EXPECT_EQ(run.at("parentSpanId"), root.at("spanId"));
    const auto attempts = spans.equal_range(std::string(stage) + " task");
    for (auto it = attempts.first; it != attempts.second; ++it)
      EXPECT_EQ(it->second.at("parentSpanId"), run.at("spanId"));
  }
  EXPECT_TRUE(WaitUntil(
      [this] { return Scrape()["orbweave_spans_total"].labels.contains("outcome"); }, 10.0));
  EXPECT_THAT(serve_->ErrSoFar(), HasSubstr("\"traceparent\":\"00-" + trace));
}

TEST_F(ObservedJob, IsDoneWithoutItsCollector) {
  uint16_t port = 0;
  { port = HttpCollector().port(); }
  Serve({"--otlp", "http://127.0.0.1:" + std::to_string(port)});
  GrpcCoordinatorClient client(address_);
  const Digest job = Submit("1 2 3");
  EXPECT_TRUE(WaitUntil([&] { return client.GetJob(job)->state == JobState::kDone; }, 60.0));
  EXPECT_TRUE(WaitUntil(
      [this] { return serve_->ErrSoFar().find("collector_away") != std::string::npos; }, 60.0));
  serve_->Signal(SIGTERM);
  EXPECT_EQ(serve_->Wait().exit_code, 0);
}

TEST_F(ObservedJob, IsNotServedWithACollectorThatIsNoneOrHttps) {
  for (const char* url : {"localhost:4318", "https://tempo.example"}) {
    const auto refused = testing::RunCommand(
        Orbweave({"serve", "--listen", address_, "--state", folder_ / "state", "--otlp", url}));
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr(url));
  }
}

void AddCommands(CLI::App& app, SelectedCommand& selected) {
  static const testing::StageMap stages = testing::ToyStages();
  static const StageLookup lookup = testing::LookupIn(stages);
  AddServeCommand(app, selected, testing::FindToyPlan);
  AddWorkCommand(app, selected);
  AddExecTasksCommand(app, selected, lookup);
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  return orbweave::testing::RunCommandOrTests(argc, argv, orbweave::AddCommands);
}
