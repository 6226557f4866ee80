#include <cstdlib>
#include <exception>
#include <iostream>

#include "test/soundness/soundness.h"

// soundness [pairs [seed]]: the tables of test/soundness/README.md. Fails when a pair is missed,
// or more false alarms are raised than may be.
int main(int argc, char** argv) {
  try {
    const auto count = static_cast<std::size_t>(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 3000);
    const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 4;
    const armloom::soundness::Report report =
        armloom::soundness::measure(count, seed, {0.1, 0.05, 0.01, 0.001});
    armloom::soundness::print_markdown(report, std::cout);
    for (const std::string& failure : report.failures) std::cout << failure << "\n";
    return report.failures.empty() && report.false_alarm_share() <= 0.01 ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << "soundness: " << e.what() << "\n";
    return 1;
  }
}
