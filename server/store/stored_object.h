#pragma once

#include <optional>
#include <string>

namespace armloom {

// What clients made of an object of the planning scene.
struct StoredObject {
  std::string name;
  std::optional<std::string> text = {};  // as it was asked for (JSON); none: it was taken away
  // The cell file has one of this name: that it was taken away has to be kept.
  bool is_of_cell = false;
};

// As the folder had it when it was opened.
struct LeftObject {
  StoredObject object;
  bool is_damaged = false;  // not as it was written: nothing of it but the name is told
};

}  // namespace armloom
