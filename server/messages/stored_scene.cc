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

// The matrix without its last row, row by row.
std::vector<double> rows_of(const Eigen::Isometry3d& pose) {
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) rows.push_back(pose(row, column));
  }
  return rows;
}

Result<Eigen::Isometry3d> pose_of(const std::vector<double>& rows) {
  if (rows.size() != 12) {
    return failure(
        Problem{ProblemKind::malformed, "bad-record", "/place", "the pose has not 12 numbers", {}});
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    pose.matrix()(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = rows[i];
  }
  return pose;
}

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
  record["place"]["pose"] = rows_of(place.object.X_WO);
  for (const HeldView::Other& other : place.shared_with) {
    record["place"]["shared_with"].push_back({{"link", other.link}, {"pose", rows_of(other.X_LO)}});
  }
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
    const auto pose = pose_of(place.at("pose").get<std::vector<double>>());
    if (!pose) return failure(pose.error());
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
    held.object.X_WO = *pose;
    for (const nlohmann::json& other : place.value("shared_with", nlohmann::json::array())) {
      const auto X_LO = pose_of(other.at("pose").get<std::vector<double>>());
      if (!X_LO) return failure(X_LO.error());
      held.shared_with.push_back({other.at("link").get<std::string>(), {}, *X_LO});
    }
    return held;
  } catch (const nlohmann::json::exception&) {
    return bad("the record is incomplete");
  }
}

}  // namespace armloom
