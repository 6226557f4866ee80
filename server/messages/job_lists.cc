#include <memory>

#include "server/codec/list_formats.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/problem.h"

namespace armloom {

using namespace formats;

namespace {

class ListedJobFormat final : public CustomFormat<ListedJob> {
 public:
  void read(const JsonNode&, ListedJob&) const override {}
  void write(JsonWriter& out, const ListedJob& job) const override {
    if (const auto* text = std::get_if<JobText>(&job)) {
      out.raw(**text);
    } else {
      job_format()->write(out, std::get<JobView>(job));
    }
  }
  Schema schema(Way way) const override { return job_format()->schema(way); }
};

// Writes {"status": 202, "job": {...}} or {"status": 422, "problem": {...}}.
class BatchResultFormat final : public CustomFormat<Result<ListedJob>> {
 public:
  void read(const JsonNode&, Result<ListedJob>&) const override {}
  void write(JsonWriter& out, const Result<ListedJob>& result) const override {
    if (result) return accepted_->write(out, *result);
    refused_->write(out, result.error());
  }
  Schema schema(Way way) const override {
    Schema accepted = accepted_->schema(way);
    accepted["properties"]["status"] = {{"const", kAccepted}};
    return {{"oneOf", Schema::array({std::move(accepted), refused_->schema(way)})}};
  }

 private:
  inline static constexpr int kAccepted = 202;
  FormatPtr<ListedJob> accepted_ = object<ListedJob>({
      output_only(
          "status", [](const ListedJob&) { return kAccepted; }, integer(kAccepted, kAccepted)),
      output_only(
          "job", [](const ListedJob& job) { return &job; }, listed_job_format()),
  });
  FormatPtr<Problems> refused_ = object<Problems>({
      output_only(
          "status", [](const Problems& why) { return status_of(why.front().kind); },
          integer(400, 599)),
      output_only(
          "problem", [](const Problems& why) { return document_of(why); }, problem_format()),
  });
};

template <class T>
FormatPtr<std::vector<T>> listed(const char* name, const char* key, FormatPtr<T> element) {
  using List = std::vector<T>;
  return named(name, "",
               object<List>({output_only(
                   key, [](const List& all) { return &all; }, list(std::move(element)))}));
}

PartPtr<QueueView> ids(const char* key, std::vector<std::string> QueueView::*where) {
  return output_only(key, where, list(text()));
}
PartPtr<QueueJobs> jobs(const char* key, std::vector<ListedJob> QueueJobs::*where,
                        const char* text = "") {
  return output_only(key, where, list(listed_job_format()), text);
}

}  // namespace

FormatPtr<ListedJob> listed_job_format() {
  static const FormatPtr<ListedJob> format = make_format<ListedJobFormat>();
  return format;
}

FormatPtr<JobPage> job_page_format() {
  static const auto format =
      named("JobPage", "",
            object<JobPage>({
                output_only("jobs", &JobPage::jobs, list<ListedJob>(listed_job_format())),
                output_only("next_cursor", &JobPage::next_cursor, nullable(text()),
                            "Value for `?cursor=` to get the next page; null on the last page"),
            }));
  return format;
}

FormatPtr<QueueView> queue_ids_format() {
  const auto policy = [](const QueueView& view) { return std::optional(view.policy); };
  const auto speed = [](const QueueView& view) { return std::optional(view.speed_override); };
  static const auto format =
      named("QueueIds", "",
            object<QueueView>({
                output_if("policy", policy, text(), "Present policy; absent in old recordings"),
                output_only("stopped", &QueueView::stopped, flag(), "true if every arm is stopped"),
                output_if("speed_override", speed, number({0.0, 1.0}),
                          "Speed override of the cell; absent in old recordings"),
                ids("queued", &QueueView::queued),
                ids("backlog", &QueueView::backlog),
                ids("scheduled", &QueueView::scheduled),
                ids("running", &QueueView::running),
            }));
  return format;
}

FormatPtr<QueueJobs> queue_format() {
  static const auto format =
      named("Queue", "",
            object<QueueJobs>({
                output_only("policy", &QueueJobs::policy, text(), "Present policy"),
                output_only("stopped", &QueueJobs::stopped, flag(), "true if every arm is stopped"),
                jobs("queued", &QueueJobs::queued),
                jobs("backlog", &QueueJobs::backlog),
                jobs("scheduled", &QueueJobs::scheduled),
                jobs("running", &QueueJobs::running, "Running and paused jobs"),
            }));
  return format;
}

FormatPtr<std::vector<ListedJob>> batch_accepted_format() {
  static const auto format = listed<ListedJob>("BatchAccepted", "jobs", listed_job_format());
  return format;
}

FormatPtr<std::vector<Result<ListedJob>>> batch_results_format() {
  static const auto format =
      listed<Result<ListedJob>>("BatchResults", "results", make_format<BatchResultFormat>());
  return format;
}

}  // namespace armloom
