#include "server/messages/stored_scene.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "server/codec/read_text.h"
#include "server/messages/scene.h"

namespace armloom {

namespace {

constexpr const char* kExpiresKey = "expires_ms";

}  // namespace

std::string text_with_expiry(const std::string& text, std::int64_t expires_ms) {
  auto record = nlohmann::json::parse(text);
  record[kExpiresKey] = expires_ms;
  return record.dump();
}

std::optional<std::int64_t> take_expiry(std::string& record) {
  if (record.find(kExpiresKey) == std::string::npos) return std::nullopt;
  auto body = nlohmann::json::parse(record, nullptr, false);
  const auto found = body.find(kExpiresKey);
  if (found == body.end() || !found->is_number_integer()) return std::nullopt;
  const auto expires_ms = found->get<std::int64_t>();
  body.erase(found);
  record = body.dump();
  return expires_ms;
}

std::string text_of_place(const HeldView& place) {
  nlohmann::json record{{"place", {{"link", place.link}}}};
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) rows.push_back(place.object.X_WO(row, column));
  }
  record["place"]["pose"] = rows;
  record["place"]["object"] = nlohmann::json::parse(text_of(*object_format(), place.object));
  return record.dump();
}

Result<std::optional<HeldView>> read_place(std::string_view text, const Cell& cell) {
  const auto record = nlohmann::json::parse(text, nullptr, false);
  if (!record.is_object() || !record.contains("place")) return std::nullopt;
  const auto bad = [](const char* why) {
    return failure(Problem{ProblemKind::malformed, "bad-record", "/place", why, {}});
  };
  try {
    const nlohmann::json& place = record.at("place");
    const auto rows = place.at("pose").get<std::vector<double>>();
    nlohmann::json body = place.at("object");
    HeldView held;
    held.link = place.at("link").get<std::string>();
    const std::string name = body.at("name").get<std::string>();
    if (body.contains("mesh")) {
      const auto known = std::ranges::find(cell.objects, name, &CollisionObject::name);
      if (known == cell.objects.end())
        return bad("the cell file has no mesh of this name any more");
      held.object = *known;
    } else {
      auto read = read_object_text(body.dump(), name);
      if (!read) return failure(std::move(read.error()));
      held.object = std::move(*read);
    }
    if (rows.size() != 12) return bad("the pose has not 12 numbers");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      held.object.X_WO.matrix()(static_cast<Eigen::Index>(i / 4),
                                static_cast<Eigen::Index>(i % 4)) = rows[i];
    }
    return held;
  } catch (const nlohmann::json::exception&) {
    return bad("the record is incomplete");
  }
}

}  // namespace armloom
