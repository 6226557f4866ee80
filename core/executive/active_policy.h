#pragma once

#include <string>

#include "core/executive/executive.h"

namespace armloom {

// The policy that decides. The executive outlives it.
class Executive::ActivePolicy {
 public:
  explicit ActivePolicy(Impl& executive) : executive_(executive) {}

  [[nodiscard]] std::string name() const;
  // From now on that one decides, until the next start. Problems: unknown-policy ("/policy");
  // conflict while a job is admitted: its orders are those of the policy that chose them.
  [[nodiscard]] Result<void> change(const std::string& name);

 private:
  Impl& executive_;
};

}  // namespace armloom
