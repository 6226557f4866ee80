#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "server/api/openapi.h"
#include "server/api/route.h"

namespace armloom {
namespace {

using nlohmann::json;

// Expects every reference to start with "#/components/" and to exist.
void expect_references_lead_somewhere(const json& document, const json& node) {
  if (node.is_object() && node.contains("$ref")) {
    const std::string reference = node["$ref"];
    ASSERT_TRUE(reference.starts_with("#/components/")) << reference;
    EXPECT_TRUE(document.contains(json::json_pointer(reference.substr(1)))) << reference;
  }
  if (!node.is_structured()) return;
  for (const json& child : node) expect_references_lead_somewhere(document, child);
}

TEST(OpenApi, HasUniqueRouteIds) {
  std::set<std::string> ids;
  for (const Route& route : all_routes()) {
    EXPECT_TRUE(ids.insert(route.id).second) << route.id << " stands twice";
    EXPECT_FALSE(route.outcomes.empty()) << route.id;
    EXPECT_EQ(route.run == nullptr, route.path == "/") << route.id;
    EXPECT_EQ(route.who == Who::commander, route.method != "GET" || route.id == "openWebSocket");
    EXPECT_EQ(route.who == Who::anyone, route.id == "health" || route.id == "ready");
  }
  EXPECT_GE(ids.size(), 25U);
}

TEST(OpenApi, HasNoDanglingReferences) {
  const json document = json::parse(openapi_text());
  EXPECT_EQ(document["openapi"].get<std::string>().substr(0, 4), "3.1.");
  expect_references_lead_somewhere(document, document);
}

TEST(Docs, LoadNoForeignUrlsAndNeverSetInnerHtml) {
  const std::string page =
      std::string(docs_html()) + std::string(docs_css()) + std::string(docs_js());
  EXPECT_EQ(page.find("://"), page.npos);
  EXPECT_EQ(page.find("innerHTML"), page.npos);
}

}  // namespace
}  // namespace armloom
