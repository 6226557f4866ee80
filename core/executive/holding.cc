#include "core/executive/holding.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>
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

std::vector<LinkId> hands_of(const Attachment& held) {
  std::vector<LinkId> links{held.link};
  for (const Attachment::Other& other : held.others) links.push_back(other.link);
  return links;
}

std::vector<LinkId> links_of_hands(const Cell& cell, const std::vector<LinkId>& hands) {
  std::vector<LinkId> links;
  for (const LinkId hand : hands) {
    const std::vector<LinkId> of_one = links_of_hand(cell, hand);
    links.insert(links.end(), of_one.begin(), of_one.end());
  }
  return links;
}

// Returns the content in which the link holds the object, too.
Result<Content> shared_with(Content& content, const Cell& cell,
                            std::vector<Attachment>::iterator held, const LinkPoses& X_WL,
                            LinkId link, Touch touch) {
  if (held == content.attachments->end()) {
    return failure(Problem{ProblemKind::conflict, "not-held", "/attach/shared",
                           "no arm holds the object: leave out \"shared\"", "true"});
  }
  const std::vector<ArmId> arms = arms_of(cell, hands_of(*held));
  if (std::ranges::count(arms, *cell.link(link).arm) > 0) {
    return failure(Problem{ProblemKind::conflict, "held-twice", "/attach/link",
                           "the arm of " + cell.link(link).name + " holds the object already",
                           cell.link(link).name});
  }
  const Eigen::Isometry3d X_WO = X_WL[held->link.index()] * held->X_LO;
  held->others.push_back({link, X_WL[link.index()].inverse(Eigen::Isometry) * X_WO});
  held->touch = std::move(touch.links);
  held->touch_objects = std::move(touch.objects);
  return std::move(content);
}

// Takes one of several hands from the object, which is at X_WO.
void let_go(Attachment& held, LinkId link, const LinkPoses& X_WL, const Eigen::Isometry3d& X_WO) {
  if (held.link == link) {
    held.link = held.others.front().link;
    held.X_LO = X_WL[held.link.index()].inverse(Eigen::Isometry) * X_WO;
    held.others.erase(held.others.begin());
  } else {
    std::erase_if(held.others, [&](const Attachment::Other& other) { return other.link == link; });
  }
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

std::vector<LinkId> hands_at(const PlanningScene& scene, const std::string& object) {
  const auto held = std::ranges::find_if(scene.attachments(), carries(object));
  return held == scene.attachments().end() ? std::vector<LinkId>{} : hands_of(*held);
}

HandsOf hands_of(const PlanningScene& scene) {
  HandsOf hands;
  for (const Attachment& held : scene.attachments()) {
    hands.emplace(held.object.name, hands_of(held));
  }
  return hands;
}

std::vector<SharedHold> shared_holds(const Cell& cell, const HandsOf& hands) {
  std::vector<SharedHold> holds;
  for (const auto& [object, links] : hands) {
    if (links.size() > 1) holds.push_back({object, arms_of(cell, links)});
  }
  return holds;
}

std::vector<ArmId> arms_of(const Cell& cell, const std::vector<LinkId>& links) {
  std::set<ArmId> arms;
  for (const LinkId link : links) arms.insert(*cell.link(link).arm);
  return {arms.begin(), arms.end()};
}

std::vector<LinkId> links_of_hand(const Cell& cell, LinkId link) {
  const std::vector<bool> hand = hand_of(cell, link);
  std::vector<LinkId> links;
  for (std::uint32_t l = 0; l < hand.size(); ++l) {
    if (hand[l]) links.emplace_back(l);
  }
  return links;
}

namespace {

Result<Content> in_hand(const PlanningScene& scene, const Configuration& measured,
                        const std::string& object, LinkId link, Touch touch, bool shared) {
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
  if (shared) return shared_with(content, cell, held, X_WL, link, std::move(touch));
  Attachment next{.object = {}, .link = link, .X_LO = {}, .touch = {}};
  if (placed != content.objects.end()) {
    next.X_LO = X_WL[link.index()].inverse(Eigen::Isometry) * placed->X_WO;
    next.object = std::move(*placed);
    content.objects.erase(placed);
  } else {
    const Eigen::Isometry3d X_WO = X_WL[held->link.index()] * held->X_LO;
    next.X_LO = X_WL[link.index()].inverse(Eigen::Isometry) * X_WO;
    next.object = std::move(held->object);
    touch.add({links_of_hands(cell, hands_of(*held))});  // still at the object
    content.attachments->erase(held);
  }
  next.touch = std::move(touch.links);
  next.touch_objects = std::move(touch.objects);
  allow(content, object, {});
  content.attachments->push_back(std::move(next));
  return content;
}

}  // namespace

Result<Content> attached(const PlanningScene& scene, const Configuration& measured,
                         const std::string& object, LinkId link, Touch touch, bool shared) {
  auto content = in_hand(scene, measured, object, link, std::move(touch), shared);
  if (!content) return content;
  const Cell& cell = scene.cell();
  if (auto overload = find_overload(cell, *cell.link(link).arm, *content->attachments)) {
    overload->pointer = "/attach/object";
    return failure(*std::move(overload));
  }
  return content;
}

Result<Content> detached(const PlanningScene& scene, const Configuration& measured,
                         const std::string& object, std::optional<LinkId> link) {
  Content content = content_of(scene);
  const auto held = std::ranges::find_if(*content.attachments, carries(object));
  const bool is_held = held != content.attachments->end();
  const std::vector<LinkId> hands = is_held ? hands_of(*held) : std::vector<LinkId>{};
  if (!is_held || (link && std::ranges::count(hands, *link) == 0)) {
    const std::string who =
        link ? scene.cell().link(*link).name + " does not hold " : "no arm holds ";
    return failure(Problem{ProblemKind::conflict, "not-held", "/detach/object",
                           who + "\"" + object + "\": attach it in a step before", object});
  }
  LinkPoses X_WL;
  forward_kinematics(scene.cell(), measured, X_WL);
  CollisionObject placed = held->object;
  placed.X_WO = X_WL[held->link.index()] * held->X_LO;
  if (link && hands.size() > 1) {
    let_go(*held, *link, X_WL, placed.X_WO);
    Touch touch{std::move(held->touch), std::move(held->touch_objects)};
    touch.add({links_of_hand(scene.cell(), *link)});  // still at the object
    held->touch = std::move(touch.links);
    held->touch_objects = std::move(touch.objects);
    return content;
  }
  allow(content, object, links_of_hands(scene.cell(), hands));
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
  const auto name_of_arm = [&](LinkId link) {
    return scene.cell().arm(*scene.cell().link(link).arm).name;
  };
  HeldView view{{held->object.name, held->object.shape, held->X_LO, held->object.mass},
                scene.cell().link(held->link).name,
                name_of_arm(held->link)};
  for (const Attachment::Other& other : held->others) {
    view.shared_with.push_back(
        {scene.cell().link(other.link).name, name_of_arm(other.link), other.X_LO});
  }
  return view;
}

Result<Attachment> attachment_of(const Cell& cell, const HeldView& view) {
  Attachment held{.object = view.object, .link = LinkId{0}, .X_LO = view.object.X_WO, .touch = {}};
  const auto find = [&](const std::string& name) -> Result<LinkId> {
    if (const auto link = cell.find_link(name)) return *link;
    return failure(Problem{ProblemKind::invalid, "unknown-link", "/link",
                           "the cell has no link \"" + name + "\"", name});
  };
  auto link = find(view.link);
  if (!link) return failure(std::move(link.error()));
  held.link = *link;
  for (const HeldView::Other& other : view.shared_with) {
    link = find(other.link);
    if (!link) return failure(std::move(link.error()));
    held.others.push_back({*link, other.X_LO});
  }
  return held;
}

Content holding(const PlanningScene& scene, Attachment held) {
  Content content = content_of(scene);
  const std::string& name = held.object.name;
  std::erase_if(content.objects, [&](const CollisionObject& o) { return o.name == name; });
  std::erase_if(*content.attachments, carries(name));
  content.attachments->push_back(std::move(held));
  return content;
}

}  // namespace armloom
