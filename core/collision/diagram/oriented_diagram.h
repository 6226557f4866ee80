#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/collision/diagram/coordination_diagram.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A coordination diagram as the side that asks sees it: A is its own motion here, whichever axis
// that is in the diagram. Empty where no two bodies can come too close. Not thread-safe; owned by
// the store (motion_store.h), but for that of a parting.
class OrientedDiagram {
 public:
  OrientedDiagram() = default;
  OrientedDiagram(CoordinationDiagram& cells, TubePair::Setting setting, bool turned)
      : cells_(&cells), setting_(std::move(setting)), turned_(turned) {}

  [[nodiscard]] explicit operator bool() const {
    return cells_ != nullptr && !setting_.pairs->empty();
  }

  // As CoordinationDiagram has them.
  [[nodiscard]] CoordinationDiagram::Answer ask(ProgressBand band, std::uint64_t budget) const;
  std::uint64_t refine(Duration resolution, std::uint64_t budget) const;  // all of both motions
  std::uint64_t refine_outline(Duration now_a, Duration now_b,
                               const CoordinationDiagram::Resolution& resolution,
                               std::uint64_t budget) const;
  std::uint64_t refine_close_passes(std::vector<ProgressBox> areas, Duration finest,
                                    std::uint64_t budget) const;
  [[nodiscard]] std::vector<CoordinationDiagram::Blocked> blocked(Duration now_a,
                                                                  Duration now_b) const;
  [[nodiscard]] std::vector<CoordinationDiagram::CellView> cells() const;

  // The closest pair there, exactly.
  [[nodiscard]] CoordinationDiagram::Witness closest_at(Duration time_a, Duration time_b) const;
  // The evidence; body_a is the own one's.
  [[nodiscard]] Proximity proximity_of(const CoordinationDiagram::Witness& found) const;
  [[nodiscard]] bool is_self(const CoordinationDiagram::Witness& found) const;

  // Pairs that are too close where both stand now may part: the same motions, nothing known yet,
  // with each of these held to kPartingShare of the distance that it has there. Empty: none is.
  inline static constexpr double kPartingShare = 0.8;
  [[nodiscard]] OrientedDiagram parting_at(Duration now_a, Duration now_b) const;
  // Lowers the bound to what every pair here is held to.
  void lower(ClearanceBound& bound) const;

 private:
  struct Parting;

  CoordinationDiagram* cells_ = nullptr;
  TubePair::Setting setting_{};
  bool turned_ = false;
  std::shared_ptr<Parting> parting_;
};

}  // namespace armloom
