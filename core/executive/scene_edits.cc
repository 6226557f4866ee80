#include "core/executive/scene_edits.h"

#include <malloc.h>

#include <memory>
#include <string>
#include <utility>

namespace armloom {
namespace {

// Largest number of waiting edits, including the one that is being prepared.
constexpr std::size_t kEditsMax = 256;
// After an edit that removes this many objects, unused memory is returned to the system.
constexpr std::size_t kManyRemoved = 100;

}  // namespace

void SceneEdits::add(Waiting edit, LiveScene& scene) {
  if (waiting_.size() >= kEditsMax) {
    edit.then(failure(Problem{ProblemKind::unavailable, "too-many-edits", "",
                              std::to_string(kEditsMax) +
                                  " changes of the scene wait, the maximum: send them in one "
                                  "PUT /scene, or wait for each answer",
                              static_cast<double>(kEditsMax)}));
    return;
  }
  waiting_.push_back(std::move(edit));
  if (waiting_.size() == 1) prepare_next(scene);
}

void SceneEdits::add_expiry(LiveScene& scene, TimePoint now) {
  if (has_expiry_) return;
  auto due = scene.due(now);
  if (!due) return;
  has_expiry_ = true;
  waiting_.push_back(
      {std::move(*due), nullptr, [this](const Result<SceneEdited>&) { has_expiry_ = false; }});
  if (waiting_.size() == 1) prepare_next(scene);
}

// Prepares the first waiting edit for the present scene, then applies it on the strand.
void SceneEdits::prepare_next(LiveScene& scene) {
  maker_.post([this, edit = std::make_shared<SceneEdit>(std::move(waiting_.front().edit)),
               base = scene.scene()]() mutable {
    auto prepared = std::make_shared<PreparedEdit>(prepare(std::move(*edit), base));
    base.reset();
    post_([this, prepared](LiveScene& present) {
      apply_first(present, *prepared);
      // The worker frees the replaced scene, so that the strand does not wait for it.
      maker_.post([prepared, count = present.objects().size()] {
        const bool many = prepared->made && prepared->made->scene &&
                          prepared->made->scene->objects().size() >= count + kManyRemoved;
        prepared->base.reset();
        prepared->made = failure(Problem{});
        if (many) malloc_trim(0);
      });
    });
  });
}

void SceneEdits::apply_first(LiveScene& scene, PreparedEdit& prepared) {
  const Waiting first = std::move(waiting_.front());
  waiting_.pop_front();
  const auto objection = first.objects_to ? first.objects_to(scene.version()) : std::nullopt;
  first.then(objection ? Result<SceneEdited>(failure(*objection)) : scene.apply(prepared));
  if (!waiting_.empty()) prepare_next(scene);
}

}  // namespace armloom
