#pragma once

namespace armloom {

inline constexpr double kTimeMax_s = 1e6;  // limit of all times given by clients

}  // namespace armloom
