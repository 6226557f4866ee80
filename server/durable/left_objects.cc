#include "server/durable/left_objects.h"

#include <utility>

#include "server/messages/problem.h"
#include "server/messages/scene.h"

namespace armloom {
namespace {

Result<void> put_back(const StoredObject& stored, LiveScene& scene) {
  const bool is_there = has_object(scene.objects(), stored.name);
  if (!stored.text) return is_there ? scene.remove(stored.name) : Result<void>();
  auto object = read_object_text(*stored.text, stored.name);
  if (!object) return failure(std::move(object.error()));
  return is_there ? scene.replace(std::move(*object)) : scene.add(std::move(*object));
}

}  // namespace

std::vector<ObjectNotPutBack> put_back(const std::vector<LeftObject>& objects, LiveScene& scene) {
  std::vector<ObjectNotPutBack> not_done;
  for (const LeftObject& left : objects) {
    const std::string what = "object \"" + left.object.name + "\" is not as it was: ";
    if (left.is_damaged) {
      not_done.push_back({left.object.name, what + "it is damaged in the data folder"});
    } else if (const auto done = put_back(left.object, scene); !done) {
      not_done.push_back({left.object.name, what + problem_sentence("", done.error().front())});
    }
  }
  return not_done;
}

}  // namespace armloom
