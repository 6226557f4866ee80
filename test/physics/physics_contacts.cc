// Checks the states of a recording with MuJoCo:
//   physics_contacts RECORDING
// RECORDING: a folder of `armloom serve --record` or `armloom simulate`, with its copy of the cell.
// Prints the contacts, then one line of JSON. Exit code 1: bodies touch, 2: cannot be read.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "server/recording/states_csv.h"
#include "test/physics/physics_cells.h"
#include "test/physics/recorded_contacts.h"

namespace armloom::test {
namespace {

int check(const std::filesystem::path& folder) {
  const CellPtr cell = cell_in(folder / "cell.json");
  std::vector<std::string> warnings;
  const auto read = read_true_states(folder, *cell, &warnings);
  if (!read) throw std::runtime_error(read.error().front().detail);
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  if (read->states.empty()) throw std::runtime_error("the recording has no states");
  const auto contacts = find_contacts(cell, read->states);
  for (const RecordedContact& contact : contacts) {
    std::printf("contact at %.3f s: %s and %s, %.1f mm deep\n", to_seconds(contact.time),
                contact.bodies.body_a.c_str(), contact.bodies.body_b.c_str(),
                1e3 * contact.bodies.depth_m);
  }
  std::printf("{\"states\": %zu, \"contacts\": %zu}\n", read->states.size(), contacts.size());
  return contacts.empty() ? 0 : 1;
}

}  // namespace
}  // namespace armloom::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: physics_contacts RECORDING\n");
    return 2;
  }
  try {
    return armloom::test::check(argv[1]);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s: %s\n", argv[1], fault.what());
    return 2;
  }
}
