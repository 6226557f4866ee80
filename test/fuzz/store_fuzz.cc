#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "server/store/job_history.h"
#include "server/store/job_store.h"
#include "test/fuzz/fuzz.h"

// Fuzzes the data folder of a killed server with a damaged database or log. An input is a list of
// five-byte records. Each record changes one byte of a sound folder with a few jobs, or truncates
// one of its files. Either the store opens and its contents are consistent, or it refuses to open
// and leaves the database unchanged. A store with a damaged log must not appear to be complete.

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

struct Folder {
  std::string database, log, mark;
};

// Returns the files that a killed server leaves behind.
Folder sound_folder() {
  fs::remove_all(folder());
  auto store = JobStore::open(folder(), {});
  demand(store.has_value());
  for (std::uint64_t number = 1; number <= 3; ++number) {
    (*store)->accept({{job(number, "queued"), R"({"arm":"left","move_to":{"named":"home"}})"}},
                     [](bool) {});
  }
  demand((*store)->flush());
  (*store)->see(job(1, "succeeded"));
  (*store)->about_to_move(2, [](bool) {});
  (*store)->amend(3, R"({"priority":2})", [](bool) {});
  (*store)->stopped({"left"});
  (*store)->note({});
  (*store)->keep({});
  demand((*store)->flush());
  return {bytes_of(folder() / "armloom.db"), bytes_of(folder() / "armloom.db-wal"),
          bytes_of(folder() / "armloom.mark")};
}

Folder damaged(Folder sound, const std::uint8_t* data, std::size_t size) {
  for (; size >= 5; data += 5, size -= 5) {
    std::string& file = data[2] % 2 == 0 ? sound.database : sound.log;
    if (file.empty()) continue;
    const std::size_t place =
        (data[0] | std::size_t{data[1]} << 8U | std::size_t{data[2]} / 2 << 16U) % file.size();
    if (data[3] % 64 == 63) {
      file.resize(place);
    } else {
      file[place] = static_cast<char>(data[4]);
    }
  }
  return sound;
}

void put(const char* name, const std::string& bytes) {
  std::ofstream(folder() / name, std::ios::binary) << bytes;
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
  static const Folder sound = sound_folder();
  const Folder left = damaged(sound, data, size);
  fs::remove_all(folder());
  fs::create_directories(folder());
  put("armloom.db", left.database);
  put("armloom.db-wal", left.log);
  put("armloom.mark", left.mark);
  {
    const auto store = JobStore::open(folder(), {});
    if (!store) {
      demand(!store.error().empty() && !store.error().front().detail.empty());
      demand(bytes_of(folder() / "armloom.db") == left.database);
      return 0;
    }
    const Leftover& found = (*store)->leftover();
    demand_whole(found);
    if (left.database == sound.database && !found.is_behind) {
      demand(found.jobs.size() == 2 && found.jobs[0].may_have_moved && found.jobs[1].amended);
      demand(found.stopped_arms.size() == 1);
    }
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
