#pragma once

#include <optional>
#include <string>

namespace armloom {

// A client's change of a scene object.
struct StoredObject {
  std::string name;
  std::optional<std::string> text = {};  // as requested (JSON); nullopt if removed
  // The cell file has an object of this name, so that its removal must be stored, too.
  bool is_of_cell = false;
};

// An object as it was when the folder was opened.
struct LeftObject {
  StoredObject object;
  bool is_damaged = false;  // only the name is reliable
};

}  // namespace armloom
