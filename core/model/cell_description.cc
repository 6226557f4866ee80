#include "core/model/cell_description.h"

namespace armloom {

const char* to_string(OnIdleBlocker value) {
  switch (value) {
    case OnIdleBlocker::report:
      return "report";
    case OnIdleBlocker::park:
      return "park";
    case OnIdleBlocker::replan:
      return "replan";
  }
  return "?";
}

const char* to_string(OnRestart value) {
  switch (value) {
    case OnRestart::ask:
      return "ask";
    case OnRestart::continue_:
      return "continue";
  }
  return "?";
}

}  // namespace armloom
