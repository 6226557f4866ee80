#include "core/executive/task_intake.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/gripper_goal.h"
#include "core/executive/hands_together.h"
#include "core/executive/job_intake.h"
#include "core/executive/signals.h"
#include "core/model/payload.h"
#include "core/trajectory/implicit_start.h"

namespace armloom {

std::string place_of_step(std::size_t i) { return "/steps/" + std::to_string(i); }

namespace {

// Checks the steps in their order.
class StepCheck {
 public:
  StepCheck(const Cell& cell, const std::vector<StepRequest>& steps, const PresentObjects& present,
            Problems& problems)
      : cell_(cell),
        steps_(steps),
        known_(present.names.begin(), present.names.end()),
        hands_(present.hands),
        masses_kg_(present.masses_kg),
        problems_(problems) {}

  void check() {
    for (at_ = 0; at_ < steps_.size(); ++at_) {
      std::visit([this](const auto& what) { look(what); }, steps_[at_].what);
      if (are_links_known(steps_[at_])) change_holding(cell_, steps_[at_], hands_);
    }
    if (std::ranges::none_of(steps_, &StepRequest::is_motion)) {
      problems_.push_back({ProblemKind::invalid,
                           "no-motion",
                           "/steps",
                           "no step moves an arm: add a motion, or set outputs with PUT /io/{name}",
                           {}});
    }
    const auto& last = steps_.back().what;
    if (std::holds_alternative<WaitRequest>(last) || std::holds_alternative<WaitIoRequest>(last)) {
      problems_.push_back(
          {ProblemKind::invalid,
           "ends-with-wait",
           place_of_step(steps_.size() - 1),
           "no step comes after this wait: leave it out, or add the step that waits",
           {}});
    }
  }

 private:
  void add(const char* slug, const std::string& member, std::string detail,
           const std::string& value) {
    problems_.push_back(
        {ProblemKind::invalid, slug, place_of_step(at_) + member, std::move(detail), value});
  }

  // Returns false if a link of the step is unknown.
  [[nodiscard]] bool are_links_known(const StepRequest& step) const {
    if (const auto* attach = std::get_if<AttachRequest>(&step.what)) {
      const auto link = cell_.find_link(attach->link);
      return link && cell_.link(*link).arm;
    }
    const auto* detach = std::get_if<DetachRequest>(&step.what);
    return detach == nullptr || detach->link.empty() || cell_.find_link(detach->link);
  }
  // Returns the arms that the step moves.
  [[nodiscard]] std::vector<ArmId> moved_by(const StepRequest& step) const {
    const auto named = [this](const std::string& name) {
      const auto arm = cell_.find_arm(name);
      return arm ? std::vector{*arm} : std::vector<ArmId>{};
    };
    if (const auto* gripper = std::get_if<GripperStepRequest>(&step.what))
      return named(gripper->arm);
    const auto* motion = std::get_if<MotionStepRequest>(&step.what);
    if (motion == nullptr) return {};
    return motion->move_to ? named(motion->arm) : arms_of(motion->trajectory, cell_);
  }
  void look_at_others(const char* member) {
    auto alone =
        find_moves_alone(cell_, hands_, moved_by(steps_[at_]), place_of_step(at_) + member);
    if (alone) problems_.push_back(*std::move(alone));
  }

  void look(const MotionStepRequest& motion) {
    look_at_others(motion.move_to ? "/move_to" : "/trajectory/joint_names");
    for (std::size_t t = 0; t < motion.triggers.size(); ++t) {
      const TriggerRequest& trigger = motion.triggers[t];
      const std::string place = "/triggers/" + std::to_string(t) + "/set_io";
      look_at_output(trigger.signal, trigger.value, place);
    }
  }
  void look(const GripperStepRequest& gripper) {
    look_at_others("/gripper");
    if (auto found = joints_at_width(cell_, gripper); !found) {
      for (Problem& problem : found.error()) {
        problem.pointer = place_of_step(at_) + problem.pointer;
        problems_.push_back(std::move(problem));
      }
    }
  }
  void look(const AttachRequest& attach) {
    look_at_object(attach.object, "/attach/object");
    look_at_touch(attach.touch, "/attach/touch");
    const auto link = cell_.find_link(attach.link);
    if (!link) {
      add("unknown-link", "/attach/link",
          "the cell has no link \"" + attach.link +
              "\": GET /cell lists the links, with the prefix "
              "of their robot",
          attach.link);
    } else if (!cell_.link(*link).arm) {
      add("link-not-of-arm", "/attach/link",
          "no arm moves link " + attach.link +
              ", so it cannot carry an object: name a link of a "
              "hand",
          attach.link);
    } else {
      const std::vector<LinkId> hands = hands_at(attach.object);
      const auto is_of_arm = [&](LinkId hand) {
        return cell_.link(hand).arm == cell_.link(*link).arm;
      };
      const bool is_twice =
          attach.shared ? std::ranges::any_of(hands, is_of_arm) : hands == std::vector{*link};
      if (is_twice) {
        add("held-twice", "/attach/object",
            attach.link + " holds " + attach.object +
                " already, now or after the jobs before: detach it before",
            attach.object);
      }
      if (attach.shared && hands.empty()) {
        add("not-held", "/attach/shared",
            "no arm holds " + attach.object +
                " then: leave out \"shared\", or attach it in a step before",
            attach.object);
      }
      look_at_mass(attach.object, *link);
      look_for_motion_of(hands, "/attach/object", attach.object);  // they must stay until then
      look_for_motion_of({*link}, "/attach/link", attach.link);
    }
  }
  void look(const DetachRequest& detach) {
    look_at_object(detach.object, "/detach/object");
    look_at_touch(detach.touch, "/detach/touch");
    const std::vector<LinkId> hands = hands_at(detach.object);
    const auto link = cell_.find_link(detach.link);
    if (!hands.empty() && link && std::ranges::count(hands, *link) == 0) {
      add("not-held", "/detach/link", detach.link + " does not hold " + detach.object + " then",
          detach.link);
    } else if (!detach.link.empty() && !link) {
      add("unknown-link", "/detach/link", "the cell has no link \"" + detach.link + "\"",
          detach.link);
    } else if (!hands.empty()) {
      look_for_motion_of(hands, "/detach/object", detach.object);
    } else if (known_.contains(detach.object)) {
      add("not-held", "/detach/object",
          "no arm holds " + detach.object + " then: attach it in a step before", detach.object);
    }
  }
  [[nodiscard]] std::vector<LinkId> hands_at(const std::string& object) const {
    const auto hands = hands_.find(object);
    return hands == hands_.end() ? std::vector<LinkId>{} : hands->second;
  }
  void look(const WaitRequest&) {}
  void look(const SetIoRequest& io) { look_at_output(io.signal, io.value, "/set_io"); }
  void look(const WaitIoRequest& io) { look_at_value(io.signal, io.value, "/wait_io"); }

  void look_at_object(const std::string& object, const char* member) {
    if (known_.contains(object)) return;
    add("unknown-object", member,
        "no object is named \"" + object +
            "\": add it first with PUT /scene/objects/{name}; GET "
            "/scene lists the objects",
        object);
  }
  // The lever of the mass shows only when the hand is at the object.
  void look_at_mass(const std::string& object, LinkId link) {
    if (!masses_kg_.contains(object)) return;
    const ArmId arm = *cell_.link(link).arm;
    std::vector<Attachment> held;
    for (const auto& [name, kg] : masses_kg_) {
      const auto arms = arms_of(cell_, hands_at(name));
      if (name != object && std::ranges::count(arms, arm) == 0) continue;
      Attachment& one = held.emplace_back(Attachment{.object = {}, .link = link, .touch = {}});
      one.object.name = name;
      one.object.mass.kg = kg;
    }
    auto overload = find_overload(cell_, arm, held);
    if (!overload) return;
    overload->pointer = place_of_step(at_) + "/attach/object";
    problems_.push_back(*std::move(overload));
  }
  void look_at_touch(const std::vector<std::string>& names, const char* member) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (cell_.find_link(names[i]) || known_.contains(names[i])) continue;
      add("unknown-name", std::string(member) + "/" + std::to_string(i),
          "neither a link nor an object is named \"" + names[i] + "\"", names[i]);
    }
  }
  void look_at_value(const std::string& signal, const SignalValue& value, const std::string& at) {
    const std::string place = place_of_step(at_) + at;
    auto bad = find_bad_value(cell_.io, signal, value, ProblemKind::invalid, place + "/name",
                              place + "/value");
    if (bad) problems_.push_back(*std::move(bad));
  }
  void look_at_output(const std::string& signal, const SignalValue& value, const std::string& at) {
    look_at_value(signal, value, at);
    const auto id = cell_.io.find_signal(signal);
    if (!id) return;
    const SignalDescription& known = cell_.io.signal(*id);
    if (known.direction == SignalDirection::output || !known.place) return;
    add("input-of-device", at + "/name",
        signal + " is an input of a device: only outputs and simulated inputs can be set", signal);
  }
  // The arms must stay with the task: others could move them otherwise, before the action is done.
  void look_for_motion_of(const std::vector<LinkId>& hands, const char* member,
                          const std::string& value) {
    for (const ArmId arm : arms_of(cell_, hands)) {
      const auto moves = [&](const StepRequest& step) {
        return std::ranges::count(moved_by(step), arm) > 0;
      };
      const auto after = steps_.begin() + static_cast<std::ptrdiff_t>(at_) + 1;
      if (std::any_of(after, steps_.end(), moves)) continue;
      add("no-motion-after", member,
          "no step after this one moves " + cell_.arm(arm).name +
              ": add a motion of this arm, so that the job keeps the arm until this step is done",
          value);
    }
  }

  const Cell& cell_;
  const std::vector<StepRequest>& steps_;
  std::set<std::string> known_;
  HandsOf hands_;
  const std::map<std::string, double>& masses_kg_;
  Problems& problems_;
  std::size_t at_ = 0;
};

}  // namespace

void find_bad_steps(const Cell& cell, const std::vector<StepRequest>& steps,
                    const PresentObjects& present, Problems& problems) {
  StepCheck(cell, steps, present, problems).check();
}

PresentObjects present_objects(const PlanningScene& scene) {
  PresentObjects present{.names = {}, .hands = hands_of(scene)};
  const auto add = [&](const CollisionObject& object) {
    present.names.push_back(object.name);
    if (object.mass.kg > 0.0) present.masses_kg.emplace(object.name, object.mass.kg);
  };
  for (const CollisionObject& object : scene.objects()) add(object);
  for (const Attachment& held : scene.attachments()) add(held.object);
  return present;
}

std::optional<std::string> find_misfit(const Cell& cell, const std::vector<StepRequest>& steps,
                                       const PresentObjects& present) {
  Problems problems;
  find_bad_steps(cell, steps, present, problems);
  for (const Problem& problem : problems) {
    const bool is_of_holding = problem.slug == "not-held" || problem.slug == "held-twice" ||
                               problem.slug == "no-motion-after" || problem.slug == "moves-alone";
    if (is_of_holding) return problem.detail;
  }
  return std::nullopt;
}

std::vector<PreparedJob::PreparedStep> JobIntake::read_steps(const JobRequest& request,
                                                             Ahead& ahead,
                                                             Problems& problems) const {
  if (request.terms.reorderable) {
    problems.push_back({ProblemKind::invalid, "not-served", "/reorderable",
                        "a job with steps cannot be reordered: leave out \"reorderable\"", "true"});
  }
  PresentObjects present = present_objects(*scene_());
  present.hands = hands(ahead);
  find_bad_steps(*cell_, request.steps, present, problems);
  if (!problems.empty()) return {};
  std::vector<TouchOf> touch = touch_during(*cell_, request.steps, present.hands);
  std::vector<PreparedJob::PreparedStep> steps;
  bool acts_before = false, is_first = true;
  const TouchOf* before = nullptr;
  HandsTogether together(*cell_, scene_()->attachments());
  for (std::size_t i = 0; i < request.steps.size(); ++i) {
    const StepRequest& asked = request.steps[i];
    PreparedJob::PreparedStep& step = steps.emplace_back();
    step.step.request = asked;
    change_holding(*cell_, asked, present.hands);
    if (!asked.is_motion()) {
      acts_before = true;
      continue;
    }
    Problems found;
    step.motion = read_step(asked, request, is_first, ahead, found);
    if (found.empty()) together.find_apart(*step.motion, present.hands, ahead.rest, found);
    add_below(place_of_step(i), std::move(found), problems);
    if (!problems.empty()) return {};
    const bool is_gripper = std::holds_alternative<GripperStepRequest>(asked.what);
    const bool changes = before == nullptr ? !touch[i].empty() : touch[i] != *before;
    step.step.is_awaited = acts_before || is_gripper || changes;
    step.step.touch = touch[i];
    before = &touch[i];
    acts_before = is_first = false;
  }
  ahead.hands = std::move(present.hands);
  return steps;
}

PreparedMotion JobIntake::read_step(const StepRequest& asked, const JobRequest& request,
                                    bool is_first, Ahead& ahead, Problems& problems) const {
  if (const auto* gripper = std::get_if<GripperStepRequest>(&asked.what)) {
    auto motion = gripper_motion(*gripper, *cell_, ahead.rest);
    if (!motion) {
      problems = std::move(motion.error());
      return {};
    }
    set_joints(ahead.rest, **motion, (*motion)->goal());
    return {{*std::move(motion)}, {}};
  }
  const auto& motion = std::get<MotionStepRequest>(asked.what);
  JobRequest alone;
  alone.trajectory = motion.trajectory;
  alone.move_to = motion.move_to;
  alone.arm = motion.arm;
  alone.speed = motion.speed ? motion.speed : request.speed;
  if (is_first) alone.terms.move_to_start = request.terms.move_to_start;
  if (motion.move_to) alone.terms.move_to_start = MoveToStart::none;
  return read_motion(alone, ahead, problems);
}

}  // namespace armloom
