#pragma once

#include "test/model/test_cells.h"

namespace armloom {

inline CellDescription cell_with_urdf(const ScratchFolder& folder, const std::string& text) {
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf = folder.write("twin.urdf", text);
  return cell;
}
inline std::string robot_of(const std::string& body) {
  return "<robot name='r'>" + body + "</robot>";
}

}  // namespace armloom
