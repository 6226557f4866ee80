#pragma once

#include <optional>
#include <string>

namespace armloom {

// A speed override that a client set.
struct StoredSpeed {
  std::string arm;                       // "": the cell
  std::optional<std::string> text = {};  // as requested (JSON); nullopt to forget it
};

// An override as it was when the folder was opened.
struct LeftSpeed {
  StoredSpeed speed;
  bool is_damaged = false;
};

}  // namespace armloom
