#include <cctype>
#include <iostream>
#include <nlohmann/json.hpp>

#include "server/command/command.h"
#include "server/store/job_history.h"

namespace armloom {
namespace {

using Json = nlohmann::ordered_json;

// Quotes a CSV field if necessary (RFC 4180).
std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quotes = "\"";
  for (char c : text) quotes += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quotes + '"';
}

// Prevents formula injection: a spreadsheet must not take a client's text for a formula.
std::string csv_field(const std::string& text) {
  const bool may_be_formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  return csv_quoted(may_be_formula ? "'" + text : text);
}

std::string cell_of(const Json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? csv_field(value.get<std::string>()) : csv_quoted(value.dump());
}

constexpr const char* kColumns[] = {"id",           "name",       "state",    "priority",
                                    "submitted_at", "started_at", "ended_at", "duration_s"};

void print_row(const Json& job) {
  std::string line;
  for (const char* column : kColumns) line += cell_of(job.value(column, Json())) + ",";
  std::string arms;
  for (const Json& arm : job.value("arms", Json::array())) {
    arms += (arms.empty() ? "" : " ") + arm.get<std::string>();
  }
  const Json result = job.value("result", Json());
  const auto of_result = [&](const char* key) {
    return result.is_object() ? cell_of(result.value(key, Json())) : std::string();
  };
  std::cout << line << csv_field(arms) << ',' << of_result("reason") << ',' << of_result("detail")
            << "\r\n";
}

void print_header() {
  for (const char* column : kColumns) std::cout << column << ',';
  std::cout << "arms,reason,detail\r\n";
}

}  // namespace

int print_history(const HistoryOptions& options) {
  const auto history = JobHistory::open(options.data);
  if (!history) return refuse("", history.error());
  if (options.csv) print_header();
  const auto read = (*history)->oldest_first({.state = options.state, .arm = options.arm},
                                             [&](const StoredJob& job) {
                                               if (options.csv)
                                                 return print_row(Json::parse(job.view));
                                               std::cout << job.view << '\n';
                                             });
  if (!read) return refuse("", read.error());
  std::cout.flush();
  return std::cout ? kExitDone : kExitNotWritten;
}

}  // namespace armloom
