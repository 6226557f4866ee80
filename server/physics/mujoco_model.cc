#include "server/physics/mujoco_model.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace armloom {
namespace {

void abort_with(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);
  std::abort();
}
void ignore(const char*) {}  // mjData counts warnings

// MuJoCo's file system in memory, with one file.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : files_(std::make_unique<mjVFS>()) {
    mj_defaultVFS(files_.get());
    mj_makeEmptyFileVFS(files_.get(), kName, static_cast<int>(text.size()));
    std::copy(text.begin(), text.end(),
              static_cast<char*>(files_->filedata[mj_findFileVFS(files_.get(), kName)]));
  }
  ~MemoryFile() { mj_deleteVFS(files_.get()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  // Returns null, with MuJoCo's message in `error`, if MuJoCo refuses the model.
  [[nodiscard]] mjModel* load(std::array<char, 1000>& error) const {
    return mj_loadXML(kName, files_.get(), error.data(), static_cast<int>(error.size()));
  }

 private:
  static constexpr const char* kName = "cell.xml";
  std::unique_ptr<mjVFS> files_;
};

}  // namespace

void DeleteMujoco::operator()(mjModel_* model) const { mj_deleteModel(model); }
void DeleteMujoco::operator()(mjData_* data) const { mj_deleteData(data); }

Result<std::unique_ptr<MujocoModel>> MujocoModel::compile(Mjcf mjcf) {
  static std::mutex mutex;  // mj_loadXML keeps the last model in global variables
  const std::lock_guard lock(mutex);
  mju_user_error = abort_with;
  mju_user_warning = ignore;
  std::array<char, 1000> error{};
  mjModel* model = MemoryFile(mjcf.text).load(error);
  if (model == nullptr) {
    return failure({ProblemKind::unsupported, "physics-model", "physics",
                    std::string("MuJoCo refuses the robot: ") + error.data()});
  }
  return std::unique_ptr<MujocoModel>(new MujocoModel(std::move(mjcf), model));
}

MujocoModel::MujocoModel(Mjcf mjcf, mjModel_* model) : mjcf_(std::move(mjcf)), model_(model) {
  data_.reset(mj_makeData(model_.get()));
  for (std::size_t i = 0; i < mjcf_.driven.size(); ++i) {
    const std::string name = "J" + std::to_string(i);
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, name.c_str());
    dofs_.push_back(model_->jnt_dofadr[joint]);  // hinges and slides: also the index in qpos
    model_->dof_frictionloss[dofs_.back()] = mjcf_.driven[i].friction;
  }
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    const char* name = mj_id2name(model_.get(), mjOBJ_BODY, model_->geom_bodyid[geom]);
    body_of_geom_.push_back(static_cast<std::size_t>(std::stoul(name + 1)));
  }
}

void MujocoModel::set_positions(const Configuration& q) {
  for (std::size_t i = 0; i < dofs_.size(); ++i) {
    const DrivenLink& link = mjcf_.driven[i];
    data_->qpos[dofs_[i]] =
        link.multiplier * q[static_cast<Eigen::Index>(link.driver.index())] + link.offset;
  }
}

void MujocoModel::add_contacts(std::vector<BodyContact>& contacts) const {
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const auto [a, b] = std::minmax(body_of_geom_[static_cast<std::size_t>(contact.geom1)],
                                    body_of_geom_[static_cast<std::size_t>(contact.geom2)]);
    const std::string& body_a = mjcf_.bodies[a];
    const std::string& body_b = mjcf_.bodies[b];
    const auto known = std::find_if(contacts.begin(), contacts.end(), [&](const BodyContact& c) {
      return c.body_a == body_a && c.body_b == body_b;
    });
    if (known == contacts.end()) {
      contacts.push_back({body_a, body_b, -contact.dist});
    } else {
      known->depth_m = std::max(known->depth_m, -contact.dist);
    }
  }
}

void MujocoModel::set_lock(std::size_t i, bool locked) {
  model_->eq_data[i * mjNEQDATA] = data_->qpos[dofs_[i]];
  model_->eq_active[i] = locked ? 1 : 0;
}

bool MujocoModel::is_locked(std::size_t i) const { return model_->eq_active[i] != 0; }

int MujocoModel::body(std::string_view name) const {
  const auto found = std::find(mjcf_.bodies.begin(), mjcf_.bodies.end(), name);
  if (found == mjcf_.bodies.end()) throw std::out_of_range("no body " + std::string(name));
  const std::string number = "B" + std::to_string(found - mjcf_.bodies.begin());
  return mj_name2id(model_.get(), mjOBJ_BODY, number.c_str());
}

Eigen::Isometry3d MujocoModel::pose(std::string_view name) const {
  const int id = body(name);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Map<const Eigen::Vector3d>(data_->xpos + std::ptrdiff_t{3} * id);
  X.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
      data_->xmat + std::ptrdiff_t{9} * id);
  return X;
}

}  // namespace armloom
