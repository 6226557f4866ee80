#include "core/executive/guard_words.h"

#include <cstdio>

namespace armloom {
namespace {

std::string stretch(Duration from, Duration to) {
  char text[64];
  std::snprintf(text, sizeof text, from == to ? "at %.3f s" : "from %.3f s to %.3f s",
                to_seconds(from), to_seconds(to));
  return text;
}

std::string reason(const GuardRefusal& refusal, const Cell& cell) {
  const std::string other = refusal.other ? cell.arm(*refusal.other).name : "the scene";
  switch (refusal.why) {
    case GuardRefusal::Why::uncertified:
      return "no certificate of the present scene covers this together with " + other;
    case GuardRefusal::Why::region:
      return other + " is, or may go, " + stretch(refusal.asked.from_b, refusal.asked.to_b) +
             " of its motion, and these positions are in a conflict region";
    case GuardRefusal::Why::busy:
      return "the arm is on another motion";
    case GuardRefusal::Why::out_of_step:
      return "the arms of its motion are farther apart on the path than is certified";
  }
  return "";
}

}  // namespace

std::string sentence(const GuardRefusal& refusal, const Cell& cell) {
  return "authority guard: " + cell.arm(refusal.arm).name + " may not go " +
         stretch(refusal.asked.from_a, refusal.asked.to_a) + ": " + reason(refusal, cell);
}

}  // namespace armloom
