#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string_view>

#include "test/soundness/filter_check.h"
#include "test/soundness/soundness.h"
#include "test/soundness/surface_check.h"
#include "test/soundness/undecided.h"

namespace armloom::soundness {
namespace {

std::uint64_t number(int argc, char** argv, int at, std::uint64_t otherwise) {
  return argc > at ? std::strtoull(argv[at], nullptr, 10) : otherwise;
}

bool pairs(std::size_t count, std::uint64_t seed, bool holding) {
  const Report report = measure(count, seed, {0.1, 0.05, 0.01, 0.001}, holding);
  print_markdown(report, std::cout);
  for (const std::string& failure : report.failures) std::cout << failure << "\n";
  return report.failures.empty() && report.false_alarm_share() <= 0.01;
}

bool filters(std::size_t states, std::uint64_t seed) {
  bool sound = true;
  std::cout << "| cell | states | pairs of parts compared | filter above the exact distance | "
               "rounding margin |\n|---|---|---|---|---|\n";
  for (const char* name :
       {"two_pandas.json", "panda_and_ur5e.json", "dual_panda.json", "two_shuttles.json"}) {
    const CellPtr cell = cell_of_file(name);
    const FilterReport report = check_filter(cell, states, seed);
    std::cout << "| " << name << " | " << report.states << " | " << report.part_pairs << " | "
              << report.too_far << " | " << report.margin_m * 1e6 << " um |\n";
    for (const std::string& failure : report.failures) std::cout << failure << "\n";
    sound = sound && report.too_far == 0 && report.left_out == 0;
  }
  return sound;
}

bool surfaces(std::size_t count, std::uint64_t seed) {
  const SurfaceReport report = check_surfaces(count, seed);
  std::cout << "| pairs | apart | in contact | of these, one inside the other | apart "
               "although pieces are closer than 1 mm | distance too large | false contacts | "
               "shortfall |\n"
               "|---|---|---|---|---|---|---|---|\n| "
            << report.pairs << " | " << report.apart << " | " << report.in_contact << " | "
            << report.inside << " | " << report.opened << " | " << report.too_far << " | "
            << report.false_contacts << " | " << report.shortfall_m * 1e9 << " nm |\n";
  for (const std::string& failure : report.failures) std::cout << failure << "\n";
  return report.too_far == 0 && report.false_contacts == 0;
}

// Reports pairs that stay open at 5 mm clearance and 1 mrad tracking error.
bool open(std::size_t count, std::uint64_t seed) {
  const struct {
    const char* name;
    CheckMethod method;
  } methods[] = {{"swept", Swept{0.001}}, {"coordinated", Coordinated{0.001}}};
  bool kept = true;
  std::cout << "| method | pairs | free | conflict | open | smallest distance (mm) | evaluations, "
               "mean / most |\n|---|---|---|---|---|---|---|\n";
  for (const auto& [name, method] : methods) {
    const OpenPairs found = find_open(count, seed, method);
    std::cout << "| " << name << " | " << found.pairs << " | " << found.free << " | "
              << found.conflict << " | " << found.open.size() << " |";
    for (const OpenPair& pair : found.open) {
      std::cout << " " << std::round(1e4 * pair.keeps_m) / 10.0 << " (" << pair.pair << ")";
      kept = kept && pair.keeps_m < kCloseClearance_m + kHardly_m;
    }
    std::cout << " | " << std::round(found.evaluations_mean) << " / " << found.evaluations_max
              << " |" << std::endl;
  }
  return kept;
}

}  // namespace
}  // namespace armloom::soundness

// soundness pairs|held|filter|open|surfaces [count [seed]]: prints a table of README.md; fails if a
// claim is violated.
int main(int argc, char** argv) {
  using namespace armloom::soundness;
  try {
    const std::string_view what = argc > 1 ? argv[1] : "pairs";
    const std::uint64_t seed = number(argc, argv, 3, 6);
    if (what == "filter") return filters(number(argc, argv, 2, 200'000), seed) ? 0 : 1;
    if (what == "pairs" || what == "held") {
      return pairs(number(argc, argv, 2, 3000), seed, what == "held") ? 0 : 1;
    }
    if (what == "open") return open(number(argc, argv, 2, 1500), number(argc, argv, 3, 77)) ? 0 : 1;
    if (what == "surfaces") {
      return surfaces(number(argc, argv, 2, 60'000), number(argc, argv, 3, 51)) ? 0 : 1;
    }
    std::cerr << "usage: soundness pairs|held|filter|open|surfaces [count [seed]]\n";
  } catch (const std::exception& e) {
    std::cerr << "soundness: " << e.what() << "\n";
  }
  return 1;
}
