#pragma once

#include <string>

#include "core/executive/executive.h"

namespace armloom {

// Reads and changes the policy in use. The executive outlives this object.
class Executive::ActivePolicy {
 public:
  explicit ActivePolicy(Impl& executive) : executive_(executive) {}

  [[nodiscard]] std::string name() const;
  // Changes the policy, until the server starts again. Problems: unknown-policy ("/policy");
  // conflict while a job is admitted, because its passing orders belong to the policy that chose
  // them.
  [[nodiscard]] Result<void> change(const std::string& name);

 private:
  Impl& executive_;
};

}  // namespace armloom
