#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "server/store/job_history.h"
#include "server/store/job_store.h"
#include "test/fuzz/fuzz.h"

// A data folder whose database is damaged. An input is a list of (place, byte): each five bytes of
// it change one byte of a sound database of a few jobs; a sixth kind cuts the file off there. The
// store opens it and what it tells holds together, or it refuses and leaves the file as it is.

namespace armloom::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path folder() {
  const char* scratch = std::getenv("ARMLOOM_FUZZ_SCRATCH");
  return (scratch != nullptr ? fs::path(scratch) : fs::temp_directory_path()) / "store";
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

StoredJob job(std::uint64_t number, const char* state) {
  StoredJob job;
  job.number = number;
  job.id = "job-" + std::to_string(number);
  job.state = state;
  job.has_ended = job.state == "succeeded";
  job.submitted_ms = 1000;
  if (job.has_ended) job.ended_ms = 2000;
  job.arms = R"(["left"])";
  job.view = R"({"id":")" + job.id + "\"}";
  return job;
}

// What a server leaves behind.
std::string sound_database() {
  fs::remove_all(folder());
  {
    auto store = JobStore::open(folder(), {});
    demand(store.has_value());
    for (std::uint64_t number = 1; number <= 3; ++number) {
      (*store)->accept({{job(number, "queued"), R"({"arm":"left","move_to":{"named":"home"}})"}},
                       [](bool) {});
    }
    (*store)->see(job(1, "succeeded"));
    (*store)->about_to_move(2, [](bool) {});
    (*store)->amend(3, R"({"priority":2})", [](bool) {});
    (*store)->stopped({"left"});
    (*store)->note({});
    (*store)->keep({});
    demand((*store)->flush());
    demand(!(*store)->close());
  }
  return bytes_of(folder() / "armloom.db");
}

std::string damaged(std::string database, const std::uint8_t* data, std::size_t size) {
  for (; size >= 5 && !database.empty(); data += 5, size -= 5) {
    const std::size_t place =
        (data[0] | std::size_t{data[1]} << 8U | std::size_t{data[2]} << 16U) % database.size();
    if (data[3] % 64 == 63) {
      database.resize(place);
    } else {
      database[place] = static_cast<char>(data[4]);
    }
  }
  return database;
}

void demand_whole(const Leftover& left) {
  std::uint64_t last = 0;
  for (const LeftJob& one : left.jobs) {
    demand(one.job.number > last);
    last = one.job.number;
  }
}

}  // namespace
}  // namespace armloom::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armloom;
  using namespace armloom::fuzz;
  namespace fs = std::filesystem;
  static const std::string sound = sound_database();
  const std::string bytes = damaged(sound, data, size);
  fs::remove_all(folder());
  fs::create_directories(folder());
  std::ofstream(folder() / "armloom.db", std::ios::binary) << bytes;
  {
    const auto store = JobStore::open(folder(), {});
    if (!store) {
      demand(!store.error().empty() && !store.error().front().detail.empty());
      demand(bytes_of(folder() / "armloom.db") == bytes);
      return 0;
    }
    demand_whole((*store)->leftover());
    (*store)->see(job(7, "queued"));
    (void)(*store)->flush();
    (void)(*store)->close();
  }
  const auto history = JobHistory::open(folder());
  if (!history) return 0;
  (void)(*history)->find("job-1");
  (void)(*history)->audit({}, 10);
  (void)(*history)->oldest_first({}, [](const StoredJob&) {});
  return 0;
}
