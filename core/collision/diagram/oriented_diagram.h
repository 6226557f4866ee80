#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/collision/diagram/coordination_diagram.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A view of a coordination diagram in which A is always the asking motion. Empty if no two bodies
// can come too close. Not thread-safe. The store (motion_store.h) owns the cells, except those of
// parting_at().
class OrientedDiagram {
 public:
  OrientedDiagram() = default;
  OrientedDiagram(CoordinationDiagram& cells, TubePair::Setting setting, bool turned)
      : cells_(&cells), setting_(std::move(setting)), turned_(turned) {}

  [[nodiscard]] explicit operator bool() const {
    return cells_ != nullptr && !setting_.pairs->empty();
  }

  // See CoordinationDiagram.
  [[nodiscard]] CoordinationDiagram::Answer ask(ProgressBand band, std::uint64_t budget) const;
  std::uint64_t refine(Duration resolution, std::uint64_t budget) const;  // both whole motions
  std::uint64_t refine_outline(Duration now_a, Duration now_b,
                               const CoordinationDiagram::Resolution& resolution,
                               std::uint64_t budget) const;
  std::uint64_t refine_close_passes(std::vector<ProgressBox> areas, Duration finest,
                                    std::uint64_t budget) const;
  [[nodiscard]] std::vector<CoordinationDiagram::Blocked> blocked(Duration now_a,
                                                                  Duration now_b) const;
  [[nodiscard]] std::vector<CoordinationDiagram::CellView> cells() const;

  // Returns the closest pair at these times, with its exact distance.
  [[nodiscard]] CoordinationDiagram::Witness closest_at(Duration time_a, Duration time_b) const;
  // Returns the names and distance of the pair; body_a belongs to the asking motion.
  [[nodiscard]] Proximity proximity_of(const CoordinationDiagram::Witness& found) const;
  [[nodiscard]] bool is_self(const CoordinationDiagram::Witness& found) const;

  // Returns a new diagram for pairs that are too close now and may part (let_part). Empty if no
  // pair is too close (TubePair::near_at).
  [[nodiscard]] OrientedDiagram parting_at(Duration now_a, Duration now_b) const;
  // Lowers the bound to the smallest limits of this diagram's pairs.
  void lower(ClearanceBound& bound) const;

 private:
  struct Parting;

  CoordinationDiagram* cells_ = nullptr;
  TubePair::Setting setting_{};
  bool turned_ = false;
  std::shared_ptr<Parting> parting_;
};

}  // namespace armloom
