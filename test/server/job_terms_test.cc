// The terms of a job are stored with the job and returned with it; one description defines reader,
// writer and schema.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "server/codec/json_writer.h"
#include "server/messages/job.h"
#include "server/messages/job_amendment.h"
#include "server/messages/job_request.h"

namespace armloom {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

const char* const kMotion = R"("trajectory": {"joint_names": ["a"], "points": [
    {"positions": [1], "velocities": [0], "time_from_start": 0}]})";

Result<JobRequest> asked_for(const std::string& terms) {
  return read_job_text("{" + terms + (terms.empty() ? "" : ", ") + kMotion + "}");
}

json told(const JobTerms& terms) {
  JobView job{.id = JobId{7}, .key = "a", .terms = terms};
  JsonWriter out;
  job_format()->write(out, job);
  return json::parse(out.take());
}

TEST(JobTerms, AreReturnedAsRequested) {
  const json asked = {{"priority", -3},
                      {"backlog_timeout_s", 1.5},
                      {"on_timeout", "replan"},
                      {"move_to_start", "plan"},
                      {"reorderable", true}};
  std::string text = asked.dump();
  const auto job = asked_for(text.substr(1, text.size() - 2));
  ASSERT_TRUE(job) << job.error().front().detail;
  const json is_told = told(job->terms);
  for (const auto& [key, value] : asked.items())
    EXPECT_EQ(is_told.value(key, json()), value) << key;
}

TEST(JobTerms, DefaultsAreReturnedOnlyForPriorityAndOnTimeout) {
  const auto job = asked_for("");
  ASSERT_TRUE(job);
  EXPECT_FALSE(job->terms.backlog_timeout) << "the cell's";
  const json is_told = told(job->terms);
  EXPECT_EQ(is_told["priority"], 0);
  EXPECT_EQ(is_told["on_timeout"], "abort");
  EXPECT_FALSE(is_told.contains("move_to_start"));
  EXPECT_FALSE(is_told.contains("reorderable"));
  EXPECT_FALSE(is_told.contains("backlog_timeout_s"));
}

TEST(JobTerms, InvalidValuesAreRefusedWithTheirPointer) {
  const std::pair<const char*, const char*> cases[] = {
      {R"("priority": 1e7)", "/priority"},
      {R"("priority": 0.5)", "/priority"},
      {R"("backlog_timeout_s": -1)", "/backlog_timeout_s"},
      {R"("backlog_timeout_s": 1e7)", "/backlog_timeout_s"},
      {R"("on_timeout": "retry")", "/on_timeout"},
      {R"("move_to_start": "fast")", "/move_to_start"},
      {R"("reorderable": "random")", "/reorderable"},
      {R"("reorderable": null)", "/reorderable"}};
  for (const auto& [terms, pointer] : cases) {
    const auto job = asked_for(terms);
    ASSERT_FALSE(job) << terms;
    ASSERT_EQ(job.error().size(), 1U) << terms;
    EXPECT_EQ(job.error().front().pointer, pointer);
  }
  EXPECT_NE(asked_for(R"("reorderable": "random")").error().front().detail.find("true or false"),
            std::string::npos);
}

TEST(JobTerms, SchemaStatesTheDefaults) {
  const Schema in = job_request_format()->schema(Way::in);
  const Schema& properties = in["anyOf"][0]["$of"]["properties"];
  EXPECT_EQ(properties["priority"]["default"], 0);
  EXPECT_EQ(properties["on_timeout"]["default"], "abort");
  EXPECT_EQ(properties["move_to_start"]["default"], "none");
  EXPECT_EQ(properties["reorderable"]["default"], false);
  const Schema out = job_format()->schema(Way::out);
  const auto& required = out["$of"]["required"];
  const auto is_required = [&](const char* key) {
    return std::find(required.begin(), required.end(), key) != required.end();
  };
  EXPECT_TRUE(is_required("priority"));
  EXPECT_FALSE(is_required("on_timeout")) << "older versions did not tell it";
  EXPECT_FALSE(is_required("move_to_start"));
  EXPECT_FALSE(is_required("reorderable"));
}

TEST(JobTerms, AmendmentChangesOnlyTheGivenMembers) {
  JobTerms terms{.priority = 3, .backlog_timeout = 60s, .reorderable = true};
  apply(AmendedTerms{.backlog_timeout = 5s}, terms);
  EXPECT_EQ(terms.priority, 3);
  EXPECT_EQ(terms.backlog_timeout, 5s);
  apply(AmendedTerms{.priority = -1, .on_timeout = OnTimeout::replan}, terms);
  EXPECT_EQ(terms.priority, -1);
  EXPECT_EQ(terms.backlog_timeout, 5s);
  EXPECT_EQ(terms.on_timeout, OnTimeout::replan);
  EXPECT_TRUE(terms.reorderable);

  JobTerms other;
  apply(amendable(terms), other);
  EXPECT_EQ(other.priority, -1);
  EXPECT_EQ(other.backlog_timeout, 5s);
  EXPECT_EQ(other.on_timeout, OnTimeout::replan);
  EXPECT_FALSE(other.reorderable) << "that cannot be changed later";
}

TEST(JobTerms, AmendmentOfFixedMembersIsRefused) {
  for (const char* text :
       {R"({"reorderable": true})", R"({"move_to_start": "plan"})", R"({"id": "b"})"}) {
    EXPECT_FALSE(read_job_amendment(text)) << text;
  }
  const auto amendment = read_job_amendment(R"({"priority": 4, "name": "b"})");
  ASSERT_TRUE(amendment);
  EXPECT_EQ(amendment->terms.priority, 4);
  EXPECT_EQ(amendment->name, "b");
  EXPECT_FALSE(amendment->terms.on_timeout);
}

TEST(JobRequests, SchemaHasNoUnsupportedMembers) {
  EXPECT_EQ(job_request_format()->schema(Way::in).dump().find("\"sub_trajectory\""),
            std::string::npos);
}

}  // namespace
}  // namespace armloom
