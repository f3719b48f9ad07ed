// Pinocchio on the robots of `peers dump`: header-only, one joint a body, in either convention.

#include "robot.hpp"

#include <memory>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody.hpp>

#include <Eigen/Eigenvalues>

namespace pin = pinocchio;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Entry {
  Robot robot;
  pin::Model model;
  std::unique_ptr<pin::Data> data;
  std::vector<int> dofs;  // Pinocchio's number of each of ours
  std::vector<VectorXd> q, v, x;
  MatrixXd H;
  VectorXd units;
  double kappa[2] = {0, 0};
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver;

  explicit Entry(Robot read) : robot(std::move(read)), dofs(robot.nv) {
    model.gravity.linear(Eigen::Vector3d(robot.gravity.data()));
    std::vector<pin::JointIndex> joints;
    std::vector<bool> floating;
    for (const Body& b : robot.bodies) {
      const Eigen::Matrix3d R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(b.rotation.data());
      const pin::SE3 placement(R, Eigen::Vector3d(b.position.data()));
      const auto parent = b.parent < 0 ? 0 : joints[b.parent];
      const bool free = b.kind == "floating";
      const auto joint = free                      ? model.addJoint(parent, pin::JointModelFreeFlyer(), placement, b.joint)
                         : b.kind == "prismatic" ? model.addJoint(parent, pin::JointModelPZ(), placement, b.joint)
                                                 : model.addJoint(parent, pin::JointModelRZ(), placement, b.joint);
      const auto& I = b.inertia;
      Eigen::Matrix3d inertia;
      inertia << I[0], I[1], I[2], I[1], I[3], I[4], I[2], I[4], I[5];
      model.appendBodyToJoint(joint, pin::Inertia(b.mass, Eigen::Vector3d(b.com.data()), inertia), pin::SE3::Identity());
      const int first = model.joints[joint].idx_v();
      for (int k = 0; k < (free ? 6 : 1); ++k) dofs[b.v + k] = first + (free ? (k + 3) % 6 : 0);
      joints.push_back(joint);
      floating.push_back(free);
    }
    data = std::make_unique<pin::Data>(model);
    for (const Sample& s : robot.samples) {
      VectorXd Q(model.nq), V(model.nv), X(model.nv);
      for (std::size_t i = 0; i < joints.size(); ++i) {
        const int from = robot.bodies[i].q, to = model.joints[joints[i]].idx_q();
        // A floating base: x, y, z, and the quaternion with w last.
        const std::array<int, 7> order = {0, 1, 2, 4, 5, 6, 3};
        for (int k = 0; k < (floating[i] ? 7 : 1); ++k) Q[to + k] = s.q[from + (floating[i] ? order[k] : 0)];
      }
      for (int d = 0; d < robot.nv; ++d) {
        V[dofs[d]] = s.v[d];
        X[dofs[d]] = s.x[d];
      }
      q.push_back(Q);
      v.push_back(V);
      x.push_back(X);
    }
    H = MatrixXd::Zero(model.nv, model.nv);
    solver = Eigen::SelfAdjointEigenSolver<MatrixXd>(model.nv);
  }

  std::vector<double> vector(const VectorXd& y) const {
    std::vector<double> out;
    for (int d : dofs) out.push_back(y[d]);
    return out;
  }

  std::vector<double> matrix() const {
    const MatrixXd full = data->M.selfadjointView<Eigen::Upper>();
    std::vector<double> out;
    for (int d : dofs)
      for (int e : dofs) out.push_back(full(d, e));
    return out;
  }

  void enter(std::map<std::string, Quantity>& quantities) {
    const auto mass = [this] { return matrix(); };
    for (const auto& [name, convention] : {std::pair{"local", pin::Convention::LOCAL}, {"world", pin::Convention::WORLD}}) {
      const std::string head = robot.name + " ", tail = std::string("-") + name;
      const auto how = convention;
      quantities[head + "upper" + tail] = {[this, how](std::size_t k) { pin::crba(model, *data, q[k], how); }, mass};
      // Both triangles, as ours and others give them.
      const auto both = [this, how](std::size_t k) {
        pin::crba(model, *data, q[k], how);
        data->M.triangularView<Eigen::StrictlyLower>() = data->M.transpose();
      };
      quantities[head + "crba" + tail] = {both, mass};
      quantities[head + "aba" + tail] = {[this, how](std::size_t k) { pin::aba(model, *data, q[k], v[k], x[k], how); },
                                         [this] { return vector(data->ddq); }};
      const auto extremes = [this, how](std::size_t k) {
        pin::crba(model, *data, q[k], how);
        H = data->M.selfadjointView<Eigen::Upper>();
        solver.compute(H, Eigen::EigenvaluesOnly);
      };
      // κ of H, and κ′ of H in units of its own diagonal.
      const auto conditioning = [this, how](std::size_t k) {
        pin::crba(model, *data, q[k], how);
        H = data->M.selfadjointView<Eigen::Upper>();
        solver.compute(H, Eigen::EigenvaluesOnly);
        const auto& l = solver.eigenvalues();
        kappa[0] = l[l.size() - 1] / l[0];
        units = H.diagonal().cwiseSqrt().cwiseInverse();
        H = units.asDiagonal() * H * units.asDiagonal();
        solver.compute(H, Eigen::EigenvaluesOnly);
        kappa[1] = l[l.size() - 1] / l[0];
      };
      quantities[head + "conditioning" + tail] = {conditioning, [this] { return std::vector<double>(kappa, kappa + 2); }};
      quantities[head + "extremes" + tail] = {extremes, [this] {
                                                const auto& l = solver.eigenvalues();
                                                return std::vector<double>{l[0], l[l.size() - 1]};
                                              }};
    }
    const std::string head = robot.name + " ";
    quantities[head + "rnea"] = {[this](std::size_t k) { pin::rnea(model, *data, q[k], v[k], x[k]); },
                                 [this] { return vector(data->tau); }};
    quantities[head + "bias"] = {[this](std::size_t k) { pin::nonLinearEffects(model, *data, q[k], v[k]); },
                                 [this] { return vector(data->nle); }};
  }
};

int main(int count, char** paths) {
  std::vector<std::unique_ptr<Entry>> entries;
  std::map<std::string, Quantity> quantities;
  std::size_t samples = 0;
  for (int i = 1; i < count; ++i) {
    entries.push_back(std::make_unique<Entry>(read_robot(paths[i])));
    entries.back()->enter(quantities);
    samples = entries.back()->robot.samples.size();
  }
  serve(quantities, samples);
}
