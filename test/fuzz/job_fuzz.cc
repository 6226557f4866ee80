#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/model/cell/build_cell.h"
#include "core/trajectory/validate.h"
#include "server/codec/cell_codec.h"
#include "server/messages/fault.h"
#include "server/messages/job_request.h"
#include "test/fuzz/problems.h"
#include "test/source_dir.h"

// Fuzzes the bodies of POST /jobs, /batches, /sim/faults and a jobs file: parsing, then validate()
// of each job on the two-Panda cell.

namespace armloom::fuzz {
namespace {

CellPtr two_pandas() {
  const std::filesystem::path folder = std::filesystem::path(source_dir()) / "config";
  std::ifstream in(folder / "two_pandas.json");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const auto description = read_cell_text(text, folder);
  demand(description.has_value());
  const auto cell = build_cell(*description);
  demand(cell.has_value());
  return *cell;
}

// Checks that an accepted trajectory can be sampled anywhere and keeps the joint limits.
void demand_moves(const Trajectory& trajectory, const Cell& cell) {
  constexpr int kInstants = 16;
  demand(trajectory.duration() > Duration::zero());
  JointState state;
  for (int i = -1; i <= kInstants + 1; ++i) {
    trajectory.sample(trajectory.duration() * i / kInstants, state);
    demand(state.position.allFinite() && state.velocity.allFinite() &&
           state.acceleration.allFinite());
    for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
      const Joint& joint = cell.joint(trajectory.joints()[j]);
      const double position = state.position[static_cast<Eigen::Index>(j)];
      demand(position >= joint.lower - kPositionOvershoot - 1e-9);
      demand(position <= joint.upper + kPositionOvershoot + 1e-9);
    }
  }
}

void try_job(const JobRequest& job, const Cell& cell) {
  const auto trajectory = validate(job.trajectory, cell);
  if (trajectory) return demand_moves(**trajectory, cell);
  demand_readable(trajectory.error());
}

}  // namespace
}  // namespace armloom::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armloom;
  static const CellPtr cell = fuzz::two_pandas();
  const std::string text = fuzz::text_of(data, size);
  if (const auto job = read_job_text(text)) {
    fuzz::try_job(*job, *cell);
  } else {
    fuzz::demand_readable(job.error());
  }
  if (const auto jobs = read_jobs_text(text)) {
    for (const TimedJob& timed : *jobs) fuzz::try_job(timed.job, *cell);
  } else {
    fuzz::demand_readable(jobs.error());
  }
  if (const auto batch = read_batch_text(text)) {
    fuzz::demand(!batch->jobs.empty());
    for (const BatchRequest::Entry& entry : batch->jobs) {
      fuzz::demand(entry.job.has_value() || !batch->atomic);
      if (entry.job) fuzz::try_job(*entry.job, *cell);
    }
  } else {
    fuzz::demand_readable(batch.error());
  }
  if (const auto fault = read_fault_text(text); !fault) fuzz::demand_readable(fault.error());
  return 0;
}
