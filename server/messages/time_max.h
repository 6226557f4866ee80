#pragma once

namespace armloom {

inline constexpr double kTimeMax_s = 1e6;  // of anything that a client names in seconds

}  // namespace armloom
