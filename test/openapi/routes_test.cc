#include <gmock/gmock.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/model/build_cell.h"
#include "server/api/api.h"
#include "server/codec/cell_codec.h"
#include "server/openapi/openapi.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

using nlohmann::json;

class Deaf final : public Observer {
 public:
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
};

std::vector<std::string> listed_routes() {
  std::vector<std::string> routes;
  const json document = json::parse(openapi_json());
  for (const auto& [path, methods] : document["paths"].items()) {
    if (path == "/") continue;  // the dashboard's files are no routes
    for (const auto& [method, operation] : methods.items()) {
      std::string name = method;
      for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      routes.push_back(name + " " + std::regex_replace(path, std::regex("\\{[^}]*\\}"), "{}"));
    }
  }
  return routes;
}

CellPtr two_pandas() {
  const std::filesystem::path file =
      std::filesystem::path(ARMLOOM_SOURCE_DIR) / "config/two_pandas.json";
  const auto description = read_cell_text(read_text_file(file).value(), file.parent_path());
  return build_cell(description.value()).value();
}

// Every reference is "#/components/schemas/Job" and leads somewhere.
void expect_references_lead_somewhere(const json& document, const json& node) {
  if (node.is_object() && node.contains("$ref")) {
    const std::string reference = node["$ref"];
    ASSERT_TRUE(reference.starts_with("#/components/")) << reference;
    EXPECT_TRUE(document.contains(json::json_pointer(reference.substr(1)))) << reference;
  }
  if (!node.is_structured()) return;
  for (const json& child : node) expect_references_lead_somewhere(document, child);
}

TEST(OpenApi, ListsExactlyTheRoutesThatTheServerHas) {
  const CellPtr cell = two_pandas();
  Deaf deaf;
  Hub hub;
  WallClock clock(std::chrono::system_clock::time_point{}, 1.0);
  const auto loop = RealTimeLoop::start(cell, {}, 1.0, deaf);
  ASSERT_TRUE(loop);
  Api api(ApiParts{cell, "stream", cell->scheduling.policy, clock, **loop, hub, nullptr, {}});
  Router router;
  api.add_routes(router);
  EXPECT_THAT(router.routes(), testing::UnorderedElementsAreArray(listed_routes()));
}

TEST(OpenApi, RefersOnlyToWhatItHolds) {
  const json document = json::parse(openapi_json());
  EXPECT_EQ(document["openapi"].get<std::string>().substr(0, 4), "3.1.");
  expect_references_lead_somewhere(document, document);
}

TEST(Docs, LoadsNothingFromElsewhereAndWritesNoHtmlFromText) {
  const std::string page(docs_html());
  EXPECT_EQ(page.find("://"), page.npos);
  EXPECT_EQ(page.find("innerHTML"), page.npos);
}

}  // namespace
}  // namespace armloom
