#pragma once

#include <string>
#include <vector>

#include "core/executive/live_scene.h"
#include "server/store/stored_object.h"

namespace armloom {

// What is not as clients of the former run had left it.
struct ObjectNotPutBack {
  std::string name;
  std::string why;  // a sentence
};

// Makes the scene what clients of the former run had made of it. On the strand, before anything
// moves.
[[nodiscard]] std::vector<ObjectNotPutBack> put_back(const std::vector<LeftObject>& objects,
                                                     LiveScene& scene);

}  // namespace armloom
