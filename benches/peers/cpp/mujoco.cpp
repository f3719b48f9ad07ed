// MuJoCo's library on the robots of `peers dump`: NAME.xml beside each NAME.robot.

#include "robot.hpp"

#include <mujoco/mujoco.h>

#include <memory>

struct Entry {
  Robot robot;
  mjModel* model;
  mjData* data;
  std::vector<int> dofs;                      // MuJoCo's number of each of ours
  std::vector<std::vector<double>> q, v;
  std::vector<double> bias;
  int base = -1;                              // our first degree of freedom of a floating base

  explicit Entry(const std::string& path) : robot(read_robot(path)), dofs(robot.nv), bias(robot.nv) {
    char error[1000] = "";
    const std::string xml = path.substr(0, path.rfind('.')) + ".xml";
    model = mj_loadXML(xml.c_str(), nullptr, error, sizeof error);
    if (!model) {
      std::cerr << xml << ": " << error << "\n";
      std::exit(1);
    }
    data = mj_makeData(model);
    std::vector<int> from(model->nq), sources(robot.nv);
    for (const Body& b : robot.bodies) {
      const bool free = b.kind == "floating";
      const int joint = mj_name2id(model, mjOBJ_JOINT, b.joint.c_str());
      if (joint < 0) {
        std::cerr << xml << ": no joint '" << b.joint << "'\n";
        std::exit(1);
      }
      for (int k = 0; k < (free ? 7 : 1); ++k) from[model->jnt_qposadr[joint] + k] = b.q + k;
      for (int k = 0; k < (free ? 6 : 1); ++k) dofs[b.v + k] = model->jnt_dofadr[joint] + (free ? (k + 3) % 6 : 0);
      if (free) base = b.v;
    }
    for (const Sample& s : robot.samples) {
      std::vector<double> Q(model->nq), V(model->nv);
      for (int i = 0; i < model->nq; ++i) Q[i] = s.q[from[i]];
      for (int d = 0; d < robot.nv; ++d) V[dofs[d]] = s.v[d];
      if (base >= 0) mju_rotVecQuat(&V[dofs[base + 3]], &s.v[base + 3], &s.q[3]);
      q.push_back(Q);
      v.push_back(V);
    }
  }

  /// A floating base's linear velocity is the world's in MuJoCo, the body's with us.
  std::vector<double> matrix() const {
    const int n = robot.nv;
    std::vector<double> full(n * n), out(n * n);
    mj_fullM(model, data, full.data());
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) out[i * n + j] = full[dofs[i] * n + dofs[j]];
    if (base < 0) return out;
    const mjtNum* quaternion = robot.samples[0].q.data() + 3;
    mjtNum conjugate[4];
    mju_negQuat(conjugate, quaternion);
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < n; ++i) mju_rotVecQuat(&out[i * n + base + 3], &out[i * n + base + 3], conjugate);
      std::vector<double> turned(n * n);
      mju_transpose(turned.data(), out.data(), n, n);
      out = turned;
    }
    return out;
  }

  void place(std::size_t k) { mju_copy(data->qpos, q[k].data(), model->nq); }

  void enter(std::map<std::string, Quantity>& quantities) {
    const auto mass = [this](std::size_t k) {
      place(k);
      mj_kinematics(model, data);
      mj_comPos(model, data);
      mj_makeM(model, data);
    };
    quantities[robot.name + " crba"] = {mass, [this] { return matrix(); }};
    const auto forces = [this](std::size_t k) {
      place(k);
      mju_copy(data->qvel, v[k].data(), model->nv);
      mj_kinematics(model, data);
      mj_comPos(model, data);
      mj_comVel(model, data);
      mj_rne(model, data, 0, bias.data());
    };
    // With a floating base the two sides differ by the acceleration of the turning frame.
    const auto result = [this] {
      std::vector<double> out;
      if (base < 0)
        for (int d : dofs) out.push_back(bias[d]);
      return out;
    };
    quantities[robot.name + " bias"] = {forces, result};
    // What mj_rne alone takes, its kinematics being there.
    quantities[robot.name + " bias-only"] = {[this](std::size_t) { mj_rne(model, data, 0, bias.data()); }, result};
  }
};

int main(int count, char** paths) {
  std::vector<std::unique_ptr<Entry>> entries;
  std::map<std::string, Quantity> quantities;
  std::size_t samples = 0;
  for (int i = 1; i < count; ++i) {
    entries.push_back(std::make_unique<Entry>(paths[i]));
    entries.back()->enter(quantities);
    samples = entries.back()->robot.samples.size();
  }
  serve(quantities, samples);
}
