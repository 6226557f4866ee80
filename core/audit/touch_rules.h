#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/audit/audited_cell.h"
#include "core/audit/recorded_scene.h"
#include "core/model/cell.h"

namespace armloom {

// The pairs that may touch in a scene: those that the cell allows, and those of RecordedScene. The
// cell and the scene must outlive it.
class TouchRules {
 public:
  TouchRules(const Cell& cell, const RecordedScene& scene);

  // Precondition: one of the solids moves. `a` is a link if one of them is.
  [[nodiscard]] bool may_touch(const AuditedSolid& a, const AuditedSolid& b) const;

 private:
  [[nodiscard]] bool held_may_touch(const AuditedSolid& held, const AuditedSolid& other) const;

  struct Held {
    const Attachment* attachment;
    std::vector<bool> hand;  // LinkId; of all hands that hold it
  };
  const Cell& cell_;
  std::map<std::string_view, Held> held_;                         // by name
  std::map<std::string_view, const std::vector<LinkId>*> touch_;  // by object
};

}  // namespace armloom
