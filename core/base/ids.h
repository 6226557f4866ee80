#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace armloom {

// A typed index: passing an ArmId for a JobId does not compile.
template <class Tag, class Rep = std::uint32_t>
class Id {
 public:
  constexpr explicit Id(Rep value) : value_(value) {}
  [[nodiscard]] constexpr Rep value() const { return value_; }
  [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value_); }
  constexpr auto operator<=>(const Id&) const = default;

 private:
  Rep value_;
};

// Dense indices into the arrays of one Cell.
using RobotId = Id<struct RobotTag>;
using ArmId = Id<struct ArmTag>;
using JointId = Id<struct JointTag>;  // a movable joint, not a mimic: one entry of a Configuration
using LinkId = Id<struct LinkTag>;    // a link of any robot of the cell
using ObjectId = Id<struct ObjectTag>;  // a collision object of the planning scene
using IoDeviceId = Id<struct IoDeviceTag>;
using SignalId = Id<struct SignalTag>;  // an input or output of the cell

// Jobs in the order of their submission: a smaller id is an earlier job. Clients see a string
// instead (JobView::key).
using JobId = Id<struct JobTag, std::uint64_t>;

// A step of a job: the unit of admission, movement authority and conflict regions. Today each job
// has one step, with index 0. The steps of one job compare in the order of execution, steps of
// different jobs in the order of submission.
struct StepId {
  JobId job;
  std::uint32_t index;

  constexpr explicit StepId(JobId of_job, std::uint32_t at = 0) : job(of_job), index(at) {}
  constexpr auto operator<=>(const StepId&) const = default;
};

// Version of the data on which a check depends (reservations, scene). A verdict names the version
// that was checked.
using Version = std::uint64_t;

}  // namespace armloom

template <class Tag, class Rep>
struct std::hash<armloom::Id<Tag, Rep>> {
  std::size_t operator()(const armloom::Id<Tag, Rep>& id) const noexcept {
    return std::hash<Rep>{}(id.value());
  }
};

template <>
struct std::hash<armloom::StepId> {
  std::size_t operator()(const armloom::StepId& id) const noexcept {
    return std::hash<armloom::JobId>{}(id.job) ^ (std::size_t{id.index} << 32U);
  }
};
