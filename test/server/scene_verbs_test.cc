#include "test/server/verbs_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;

class SceneVerbs : public test::VerbsFixture {};

TEST_F(SceneVerbs, ObjectsAreAddedMovedRemovedAndPublished) {
  start(1.0);
  test::Listener listener(port());
  const std::uint64_t version = get("/api/v1/scene").json()["version"];
  const auto added = post("/api/v1/scene/objects",
                          R"({"name": "rod 1", "cylinder": [0.01, 0.3], "xyz": [0, 0.9, 0.5]})");
  ASSERT_EQ(added.status, 201) << added.body;
  EXPECT_EQ(added.headers.at("location"), "/api/v1/scene/objects/rod%201");
  EXPECT_EQ(added.json()["version"], version + 1);
  EXPECT_EQ(added.json()["object"]["cylinder"], json({0.01, 0.3}));
  EXPECT_EQ(listener.next_of("scene")["data"]["objects"].back()["name"], "rod 1");

  const auto moved =
      put("/api/v1/scene/objects/rod%201", R"({"sphere": [0.05], "xyz": [0, 1, 0.5]})");
  EXPECT_EQ(moved.status, 200) << moved.body;
  EXPECT_EQ(get("/api/v1/scene").json()["objects"].back()["sphere"], json({0.05}));
  EXPECT_EQ(put("/api/v1/scene/objects/new", R"({"name": "new", "box": [0.1, 0.1, 0.1],
                 "xyz": [0, 1.2, 0.5]})")
                .status,
            201);
  const auto removed = remove("/api/v1/scene/objects/rod%201");
  EXPECT_EQ(removed.status, 200);
  EXPECT_EQ(removed.json()["version"], version + 4);
  expect_refused(remove("/api/v1/scene/objects/rod%201"), 404, "", "rod 1");
}

TEST_F(SceneVerbs, InvalidObjectsAreRefusedWithPlaceAndValue) {
  start(1.0);
  const std::string objects = "/api/v1/scene/objects";
  const std::uint64_t version = get("/api/v1/scene").json()["version"];
  expect_refused(post(objects, R"({"name": "table", "sphere": [0.1], "xyz": [0, 1, 1]})"), 409,
                 "/name", "table");
  expect_refused(post(objects, R"({"name": "m", "mesh": "/etc/passwd"})"), 422, "/mesh",
                 "/etc/passwd");
  expect_refused(post(objects, R"({"name": "b", "box": [1, 0, 1]})"), 422, "/box", "array of 3");
  expect_refused(post(objects, R"({"name": "b", "box": [1, 1]})"), 422, "/box", "array of 2");
  expect_refused(post(objects, R"({"name": "b"})"), 422, "", "object");
  expect_refused(post(objects, R"({"name": "b", "box": [1, 1, 1], "sphere": [1]})"), 422, "",
                 "object");
  expect_refused(post(objects, R"({"sphere": [1]})"), 422, "/name", nullptr);
  expect_refused(post(objects, R"({"name": "a/b", "sphere": [1]})"), 422, "/name", "a/b");
  expect_refused(post(objects, R"({"name": "..", "sphere": [1]})"), 422, "/name", "..");
  expect_refused(post(objects, R"({"name": "a\u007f", "sphere": [1]})"), 422, "/name", "a\x7f");
  expect_refused(
      post(objects, R"({"name": "left_panda_link4", "sphere": [0.1], "xyz": [3, 0, 1]})"), 409,
      "/name", "left_panda_link4");
  expect_refused(put(objects + "/left", R"({"sphere": [0.1], "xyz": [3, 0, 1]})"), 409, "/name",
                 "left");
  expect_refused(post(objects, R"({"name": "f", "sphere": [1], "xyz": [0, 0, 1e300]})"), 422,
                 "/xyz", "array of 3");
  expect_refused(post(objects, R"({"name": "f", "sphere": [1], "colour": "red"})"), 422, "/colour",
                 "red");
  expect_refused(put(objects + "/a", R"({"name": "b", "sphere": [1]})"), 422, "/name", "b");
  const auto into_arm = post(objects, R"({"name": "b", "sphere": [0.3], "xyz": [-0.4, 0, 0.5]})");
  EXPECT_EQ(into_arm.status, 409) << into_arm.body;
  EXPECT_EQ(into_arm.json()["type"], "urn:armloom:problem:object-in-arm");
  EXPECT_NE(into_arm.json()["detail"].get<std::string>().find("left_panda"), std::string::npos);
  EXPECT_EQ(get("/api/v1/scene").json()["version"], version);
}

TEST_F(SceneVerbs, AllObjectsAreSetAndRemovedAtOnce) {
  start(1.0);
  const std::string scene = "/api/v1/scene";
  const auto got = get(scene);
  const std::uint64_t version = got.json()["version"];
  const std::size_t of_cell = got.json()["objects"].size();
  EXPECT_EQ(got.headers.at("etag"), '"' + std::to_string(version) + '"');
  json objects = json::array();
  for (int i = 0; i < 20; ++i) {
    objects.push_back({{"name", "v" + std::to_string(i)},
                       {"box", {0.04, 0.04, 0.04}},
                       {"xyz", {0, 0.9, 0.2 + 0.05 * i}}});
  }
  const auto set = put(scene, json{{"objects", objects}, {"version", version}}.dump());
  ASSERT_EQ(set.status, 200) << set.body;
  EXPECT_EQ(set.json()["version"], version + 1);
  EXPECT_EQ(set.headers.at("etag"), '"' + std::to_string(version + 1) + '"');
  const json now = get(scene).json();
  EXPECT_EQ(now["objects"].size(), of_cell + 20) << "the cell file's objects stay";
  ASSERT_EQ(put(scene, now.dump()).status, 200) << "what GET returns can be PUT back";
  EXPECT_EQ(get(scene).json()["objects"], now["objects"]);

  expect_refused(put(scene, json{{"objects", objects}, {"version", version}}.dump()), 409,
                 "/version", std::to_string(version));
  test::Wire wire(port());
  wire.send("DELETE " + scene +
            "/objects HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 0\r\nIf-Match: \"1\"\r\n\r\n");
  expect_refused(test::read_answer(wire), 412, "If-Match", "\"1\"");
  objects.push_back(objects[3]);
  expect_refused(put(scene, json{{"objects", objects}}.dump()), 409, "/objects/20/name", "v3");
  objects.back() = {{"name", "b"}, {"sphere", {0.3}}, {"xyz", {-0.4, 0, 0.5}}};
  const auto into_arm = put(scene, json{{"objects", objects}}.dump());
  EXPECT_EQ(into_arm.status, 409) << into_arm.body;
  EXPECT_EQ(into_arm.json()["pointer"], "/objects/20");
  EXPECT_EQ(get(scene).json()["version"], version + 2) << "refused edits change nothing";

  const auto cleared = remove(scene + "/objects");
  EXPECT_EQ(cleared.status, 200) << cleared.body;
  EXPECT_EQ(cleared.json()["version"], version + 3);
  EXPECT_EQ(get(scene).json()["objects"].size(), of_cell);
}

TEST_F(SceneVerbs, PaddingEnlargesAllObjectsOfTheRequest) {
  start(1.0);
  const std::string scene = "/api/v1/scene";
  const json objects = {{{"name", "b"}, {"box", {0.1, 0.2, 0.3}}, {"xyz", {0, 0.9, 0.2}}},
                        {{"name", "c"}, {"cylinder", {0.05, 0.4}}, {"xyz", {0, 1.2, 0.2}}},
                        {{"name", "s"}, {"sphere", {0.05}}, {"xyz", {0, 1.5, 0.2}}}};
  const auto set = put(scene, json{{"objects", objects}, {"padding_m", 0.25}}.dump());
  ASSERT_EQ(set.status, 200) << set.body;
  json got = get(scene).json();
  const auto shape_of = [&](const char* name, const char* shape) {
    for (const json& object : got["objects"]) {
      if (object["name"] == name) return object[shape].get<std::vector<double>>();
    }
    return std::vector<double>();
  };
  EXPECT_EQ(shape_of("b", "box"), (std::vector{0.6, 0.7, 0.8}));
  EXPECT_EQ(shape_of("c", "cylinder"), (std::vector{0.3, 0.9}));
  EXPECT_EQ(shape_of("s", "sphere"), (std::vector{0.3}));
  ASSERT_EQ(put(scene, got.dump()).status, 200);
  EXPECT_EQ(get(scene).json()["objects"], got["objects"]) << "the padding is applied once";

  expect_refused(put(scene, json{{"objects", objects}, {"padding_m", -0.1}}.dump()), 422,
                 "/padding_m", -0.1);
  const json wide = {{{"name", "w"}, {"box", {1000, 1, 1}}, {"xyz", {0, 900, 0}}}};
  expect_refused(put(scene, json{{"objects", wide}, {"padding_m", 1}}.dump()), 422, "/objects/0",
                 1002.0);
  // 5 cm beside the left arm: the padding decides.
  const json near = {{{"name", "n"}, {"sphere", {0.05}}, {"xyz", {-0.4, 0.35, 0.5}}}};
  EXPECT_EQ(put(scene, json{{"objects", near}, {"padding_m", 0.3}}.dump()).json()["type"],
            "urn:armloom:problem:object-in-arm");
  EXPECT_EQ(put(scene, json{{"objects", near}}.dump()).status, 200);
}

TEST_F(SceneVerbs, ObjectsExpireUnlessTheyAreSetAgain) {
  start(1.0);
  test::Listener listener(port());
  const std::string scene = "/api/v1/scene";
  const json of_cell = get(scene).json()["objects"];
  const auto ball = [](const char* name, double y) {
    return json{{"name", name}, {"sphere", {0.05}}, {"xyz", {0, y, 0.2}}};
  };
  json objects = {ball("a", 0.9), ball("b", 1.1), ball("c", 1.3)};
  objects.push_back(of_cell.front());
  const auto pictures = [&](double expires_in_s) {
    return put(scene, json{{"objects", objects}, {"expires_in_s", expires_in_s}}.dump());
  };
  ASSERT_EQ(pictures(1000).status, 200);
  EXPECT_EQ(get(scene).json()["expiring"], json({"a", "b", "c"})) << "the cell's object stays";
  const double first = get(scene).json()["expires_s"];
  EXPECT_GT(first, 900.0);
  ASSERT_EQ(pictures(2000).status, 200) << "renewed";
  EXPECT_GE(get(scene).json()["expires_s"].get<double>(), first + 1000.0);
  ASSERT_EQ(put(scene + "/objects/b", ball("b", 1.15).dump()).status, 200);
  EXPECT_EQ(get(scene).json()["expiring"], json({"a", "c"})) << "b was set without a time";
  ASSERT_EQ(put(scene, get(scene).body).status, 200) << "GET's answer can be sent back";
  EXPECT_FALSE(get(scene).json().contains("expiring"));

  ASSERT_EQ(pictures(0.05).status, 200);
  json event;
  do {
    event = listener.next_of("scene")["data"];
  } while (!event.contains("expired"));
  EXPECT_EQ(event["expired"], json({"a", "b", "c"}));
  EXPECT_EQ(event["objects"].size(), of_cell.size());
  EXPECT_FALSE(event.contains("expires_s"));
  const std::string told = listener.next_of("alert")["data"]["text"];
  EXPECT_NE(told.find("3 objects have expired and left the scene: a, b, c"), told.npos) << told;
  EXPECT_EQ(get(scene).json()["objects"].size(), of_cell.size());
}

TEST_F(SceneVerbs, JobBlockedByAnObjectGoesOnWhenTheObjectExpires) {
  start(1.0);
  test::Listener listener(port());
  const json crate = {{{"name", "crate"}, {"box", {0.2, 0.2, 0.2}}, {"xyz", {-0.4, 0.3, 0.6}}}};
  const auto set = [&](double expires_in_s) {
    const json body{{"objects", crate}, {"expires_in_s", expires_in_s}};
    ASSERT_EQ(put("/api/v1/scene", body.dump()).status, 200);
  };
  set(1000);
  ASSERT_EQ(post("/api/v1/jobs", job("turn", test::kHome, test::kAside).dump()).status, 202);
  const json blocked = next_job(listener, "turn", [](const json& told) {
    return !told["waits_on"].empty() && told["waits_on"][0]["kind"] == "object";
  });
  EXPECT_EQ(blocked["waits_on"][0]["links"][1], "crate") << blocked;
  set(0.05);
  until(listener, "turn", "succeeded");
}

}  // namespace
}  // namespace armloom
