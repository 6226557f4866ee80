#include "core/executive/holding.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/collision/state/body_distance.h"
#include "core/model/attachment.h"
#include "core/model/kinematics.h"
#include "core/model/payload.h"

namespace armloom {
namespace {

using Content = PlanningScene::Content;

auto carries(const std::string& object) {
  return [&object](const Attachment& held) { return held.object.name == object; };
}

Content content_of(const PlanningScene& scene) {
  return {scene.objects(), scene.attachments(), scene.touch()};
}

void allow(Content& content, const std::string& object, std::vector<LinkId> links) {
  std::erase_if(content.touch, [&](const AllowedTouch& of) { return of.object == object; });
  if (!links.empty()) content.touch.push_back({object, std::move(links)});
}

// Returns the distance of the object from the nearest body of the hand (m).
double from_hand(const PlanningScene& scene, const LinkPoses& X_WL, const std::string& object,
                 LinkId link) {
  const PlanningScene::Bodies& bodies = scene.bodies();
  const std::vector<bool> hand = hand_of(scene.cell(), link);
  const auto is_object = [&](const CollisionBody& body) {
    return !body.link && body.name == object;
  };
  const auto found = std::ranges::find_if(bodies.bodies, is_object);
  double nearest = std::numeric_limits<double>::infinity();
  for (const CollisionBody& body : bodies.bodies) {
    if (!body.link || !hand[body.link->index()]) continue;
    const PlacedBody a{body, body.pose(X_WL)}, b{*found, found->pose(X_WL)};
    nearest = std::min(nearest, body_distance(bodies.shapes, a, b, 2.0 * kAttachWithin_m));
  }
  return nearest;
}

template <typename T>
void add_to(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
  std::ranges::sort(all);
  const auto same = std::ranges::unique(all);
  all.erase(same.begin(), same.end());
}

}  // namespace

void Touch::add(const Touch& more) {
  add_to(links, more.links);
  add_to(objects, more.objects);
}

Problem no_object(const std::string& name) {
  return Problem{ProblemKind::not_found, "unknown-object", "",
                 "no object is named \"" + name + "\": GET /scene lists the objects", name};
}

std::optional<LinkId> carrier_of(const PlanningScene& scene, const std::string& object) {
  const auto held = std::ranges::find_if(scene.attachments(), carries(object));
  return held == scene.attachments().end() ? std::nullopt : std::optional(held->link);
}

std::vector<LinkId> links_of_hand(const Cell& cell, LinkId link) {
  const std::vector<bool> hand = hand_of(cell, link);
  std::vector<LinkId> links;
  for (std::uint32_t l = 0; l < hand.size(); ++l) {
    if (hand[l]) links.emplace_back(l);
  }
  return links;
}

Result<Content> attached(const PlanningScene& scene, const Configuration& measured,
                         const std::string& object, LinkId link, Touch touch) {
  const Cell& cell = scene.cell();
  LinkPoses X_WL;
  forward_kinematics(cell, measured, X_WL);
  Content content = content_of(scene);
  const auto placed = std::ranges::find(content.objects, object, &CollisionObject::name);
  const auto held = std::ranges::find_if(*content.attachments, carries(object));
  if (placed == content.objects.end() && held == content.attachments->end()) {
    return failure(Problem{ProblemKind::invalid, "unknown-object", "/attach/object",
                           "no object is named \"" + object + "\": GET /scene lists the objects",
                           object});
  }
  const double distance_m = from_hand(scene, X_WL, object, link);
  if (distance_m > kAttachWithin_m) {
    char text[160];
    std::snprintf(
        text, sizeof text,
        " is %.0f mm or more from %s, at most %.0f mm are allowed: move the hand to the object "
        "before it is attached",
        1e3 * distance_m, cell.link(link).name.c_str(), 1e3 * kAttachWithin_m);
    return failure(
        Problem{ProblemKind::conflict, "too-far", "/attach/object", object + text, distance_m});
  }
  Attachment next{.object = {}, .link = link, .X_LO = {}, .touch = {}};
  if (placed != content.objects.end()) {
    next.X_LO = X_WL[link.index()].inverse(Eigen::Isometry) * placed->X_WO;
    next.object = std::move(*placed);
    content.objects.erase(placed);
  } else {
    const Eigen::Isometry3d X_WO = X_WL[held->link.index()] * held->X_LO;
    next.X_LO = X_WL[link.index()].inverse(Eigen::Isometry) * X_WO;
    next.object = std::move(held->object);
    const std::vector<LinkId> hand = links_of_hand(cell, held->link);  // still at the object
    touch.links.insert(touch.links.end(), hand.begin(), hand.end());
    content.attachments->erase(held);
  }
  next.touch = std::move(touch.links);
  next.touch_objects = std::move(touch.objects);
  allow(content, object, {});
  content.attachments->push_back(std::move(next));
  if (auto overload = find_overload(cell, *cell.link(link).arm, *content.attachments)) {
    overload->pointer = "/attach/object";
    return failure(*std::move(overload));
  }
  return content;
}

Result<Content> detached(const PlanningScene& scene, const Configuration& measured,
                         const std::string& object) {
  Content content = content_of(scene);
  const auto held = std::ranges::find_if(*content.attachments, carries(object));
  if (held == content.attachments->end()) {
    return failure(Problem{ProblemKind::conflict, "not-held", "/detach/object",
                           "no arm holds \"" + object + "\": attach it in a step before", object});
  }
  LinkPoses X_WL;
  forward_kinematics(scene.cell(), measured, X_WL);
  CollisionObject placed = std::move(held->object);
  placed.X_WO = X_WL[held->link.index()] * held->X_LO;
  allow(content, object, links_of_hand(scene.cell(), held->link));
  content.attachments->erase(held);
  content.objects.push_back(std::move(placed));
  return content;
}

Content touching(const PlanningScene& scene, const std::string& object, Touch touch) {
  Content content = content_of(scene);
  const auto held = std::ranges::find_if(*content.attachments, carries(object));
  if (held == content.attachments->end()) {
    content.attachments.reset();  // the diagrams of the arms stay
    allow(content, object, std::move(touch.links));
    return content;
  }
  held->touch = std::move(touch.links);
  held->touch_objects = std::move(touch.objects);
  return content;
}

Touch touch_in(const PlanningScene& scene, const std::string& object) {
  Touch touch;
  const auto held = std::ranges::find_if(scene.attachments(), carries(object));
  if (held != scene.attachments().end()) {
    touch.add({held->touch, held->touch_objects});
    return touch;
  }
  const auto allowed = std::ranges::find(scene.touch(), object, &AllowedTouch::object);
  if (allowed != scene.touch().end()) touch.add({allowed->links});
  return touch;
}

HeldView place_of(const PlanningScene& scene, const std::string& object) {
  const auto held = std::ranges::find_if(scene.attachments(), carries(object));
  if (held == scene.attachments().end()) {
    return {*std::ranges::find(scene.objects(), object, &CollisionObject::name)};
  }
  const Link& link = scene.cell().link(held->link);
  return {{held->object.name, held->object.shape, held->X_LO, held->object.mass},
          link.name,
          scene.cell().arm(*link.arm).name};
}

Content holding(const PlanningScene& scene, CollisionObject object, LinkId link) {
  Content content = content_of(scene);
  std::erase_if(content.objects, [&](const CollisionObject& o) { return o.name == object.name; });
  std::erase_if(*content.attachments, carries(object.name));
  const Eigen::Isometry3d X_LO = object.X_WO;
  content.attachments->push_back(
      {.object = std::move(object), .link = link, .X_LO = X_LO, .touch = {}});
  return content;
}

}  // namespace armloom
