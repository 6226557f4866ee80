#include <cstdlib>
#include <exception>
#include <iostream>
#include <string_view>

#include "test/soundness/filter_check.h"
#include "test/soundness/soundness.h"

namespace armloom::soundness {
namespace {

std::uint64_t number(int argc, char** argv, int at, std::uint64_t otherwise) {
  return argc > at ? std::strtoull(argv[at], nullptr, 10) : otherwise;
}

bool pairs(std::size_t count, std::uint64_t seed) {
  const Report report = measure(count, seed, {0.1, 0.05, 0.01, 0.001});
  print_markdown(report, std::cout);
  for (const std::string& failure : report.failures) std::cout << failure << "\n";
  return report.failures.empty() && report.false_alarm_share() <= 0.01;
}

bool filters(std::size_t states, std::uint64_t seed) {
  bool sound = true;
  std::cout << "| cell | states | pairs of parts compared | filter above the exact distance | "
               "rounding margin |\n|---|---|---|---|---|\n";
  for (const char* name :
       {"two_pandas.json", "panda_and_ur5e.json", "dual_panda.json", "two_fanucs.json"}) {
    const CellPtr cell = cell_of_file(name);
    if (!cell) {
      std::cout << "| " << name << " | its files are not here | | | |\n";
      continue;
    }
    const FilterReport report = check_filter(cell, states, seed);
    std::cout << "| " << name << " | " << report.states << " | " << report.part_pairs << " | "
              << report.too_far << " | " << report.margin_m * 1e6 << " um |\n";
    for (const std::string& failure : report.failures) std::cout << failure << "\n";
    sound = sound && report.too_far == 0 && report.left_out == 0;
  }
  return sound;
}

}  // namespace
}  // namespace armloom::soundness

// soundness pairs [count [seed]] | soundness filter [states [seed]]: the tables of
// test/soundness/README.md. Fails where one of the claims there does not hold.
int main(int argc, char** argv) {
  using namespace armloom::soundness;
  try {
    const std::string_view what = argc > 1 ? argv[1] : "pairs";
    const std::uint64_t seed = number(argc, argv, 3, 6);
    if (what == "filter") return filters(number(argc, argv, 2, 1'000'000), seed) ? 0 : 1;
    if (what == "pairs") return pairs(number(argc, argv, 2, 3000), seed) ? 0 : 1;
    std::cerr << "usage: soundness pairs|filter [count [seed]]\n";
  } catch (const std::exception& e) {
    std::cerr << "soundness: " << e.what() << "\n";
  }
  return 1;
}
