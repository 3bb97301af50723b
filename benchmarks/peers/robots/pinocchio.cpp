// Pinocchio on one robot: values to compare, and times.
//
//   pinocchio MODEL STATES
//
// MODEL is what `robots.py` writes: the joints of a model of Pinocchio. STATES has a count and coordinates,
// velocities and torques of each state, in the order of that model; a floating base has x, y, z, yaw, pitch, roll.
// Requests come line by line: `evaluate accelerations`, `evaluate derivatives`, `time SUBJECT SECONDS`.
//
// Times are those of a free flyer with a quaternion, as everybody uses it. Values are those of a base with
// three shifts and three angles, the coordinates of the description that they are compared with. Each is checked
// against the other before anything is answered.

#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace pinocchio;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Extended = long double;
using VectorX = Eigen::Matrix<Extended, Eigen::Dynamic, 1>;
using MatrixX = Eigen::Matrix<Extended, Eigen::Dynamic, Eigen::Dynamic>;

/// How a floating base is described.
enum class Base { quaternion, angles };

/// A model, and the damping of its joints.
struct Robot {
  Model model;
  VectorXd damping;
  bool floating = false;
};

template <class Matrix> void read(std::istream &in, Matrix &&entries) {
  for (Eigen::Index i = 0; i < entries.rows(); ++i)
    for (Eigen::Index j = 0; j < entries.cols(); ++j)
      if (!(in >> entries(i, j)))
        throw std::runtime_error("a number is missing");
}

JointModel joint(const std::string &kind, const Eigen::Vector3d &axis, Base base) {
  if (kind == "RX") return JointModelRX();
  if (kind == "RY") return JointModelRY();
  if (kind == "RZ") return JointModelRZ();
  if (kind == "PX") return JointModelPX();
  if (kind == "PY") return JointModelPY();
  if (kind == "PZ") return JointModelPZ();
  if (kind == "R") return JointModelRevoluteUnaligned(axis);
  if (kind == "P") return JointModelPrismaticUnaligned(axis);
  if (kind == "free" && base == Base::quaternion) return JointModelFreeFlyer();
  if (kind == "free") {
    JointModelComposite both;
    both.addJoint(JointModelTranslation());
    both.addJoint(JointModelSphericalZYX());
    return both;
  }
  throw std::runtime_error("unknown joint " + kind);
}

Robot load(const char *path, Base base) {
  std::ifstream in(path);
  int count = 0;
  in >> count;
  Robot robot;
  robot.model.gravity.linear() << 0.0, 0.0, -9.81;
  std::vector<double> damping;
  for (int i = 0; i < count; ++i) {
    std::string name, kind;
    JointIndex parent = 0;
    double damped = 0.0, mass = 0.0;
    Eigen::Vector3d axis, centre;
    Eigen::Matrix3d inertia;
    SE3 placement;
    if (!(in >> name >> kind >> parent)) throw std::runtime_error("a joint is missing");
    read(in, axis);
    read(in, placement.rotation());
    read(in, placement.translation());
    in >> damped >> mass;
    read(in, centre);
    read(in, inertia);
    const auto index = robot.model.addJoint(parent, joint(kind, axis, base), placement, name);
    robot.model.appendBodyToJoint(index, Inertia(mass, centre, inertia));
    if (kind == "free") {
      robot.floating = true;
      damping.insert(damping.end(), 6, 0.0);
    } else {
      damping.push_back(damped);
    }
  }
  robot.damping = Eigen::Map<VectorXd>(damping.data(), Eigen::Index(damping.size()));
  return robot;
}

struct State {
  VectorXd q, v, tau;
};

std::vector<State> states(const char *path, Eigen::Index n) {
  std::ifstream in(path);
  int count = 0;
  in >> count;
  std::vector<State> all(count, State{VectorXd(n), VectorXd(n), VectorXd(n)});
  for (auto &state : all) {
    read(in, state.q);
    read(in, state.v);
    read(in, state.tau);
  }
  return all;
}

/// The rotation of yaw, pitch, roll, and the angular velocity in the base for each of their rates.
void turn(const VectorXd &q, Eigen::Matrix3d &rotation, Eigen::Matrix3d &rates) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const Eigen::Matrix3d pitch = AngleAxisd(q[4], Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Matrix3d roll = AngleAxisd(q[5], Vector3d::UnitX()).toRotationMatrix();
  rotation = AngleAxisd(q[3], Vector3d::UnitZ()).toRotationMatrix() * pitch * roll;
  rates.col(0) = roll.transpose() * pitch.transpose() * Vector3d::UnitZ();
  rates.col(1) = roll.transpose() * Vector3d::UnitY();
  rates.col(2) = Vector3d::UnitX();
}

/// The same state of a free flyer with a quaternion.
State flying(const State &state) {
  Eigen::Matrix3d rotation, rates;
  turn(state.q, rotation, rates);
  const Eigen::Quaterniond quaternion(rotation);
  const Eigen::Index joints = state.q.size() - 6;
  State result{VectorXd(state.q.size() + 1), state.v, state.tau};
  result.q << state.q.head<3>(), quaternion.coeffs(), state.q.tail(joints);
  result.v.head<3>() = rotation.transpose() * state.v.head<3>();
  result.v.segment<3>(3) = rates * state.v.segment<3>(3);
  return result;
}

/// Accelerations and derivatives in extended precision: differences of fourth order, good beyond doubles.
class Reference {
public:
  explicit Reference(const Robot &robot)
      : model(robot.model.cast<Extended>()), data(model), damping(robot.damping.cast<Extended>()) {}

  VectorX accelerations(const VectorX &q, const VectorX &v, const VectorX &tau) {
    const VectorX torque = tau - damping.cwiseProduct(v);
    return aba(model, data, q, v, torque, Convention::LOCAL);
  }

  /// By coordinates, or by velocities.
  MatrixXd derivatives(const State &state, bool by_velocities) {
    const Extended h = 1e-4L;
    const Eigen::Index n = state.q.size();
    const VectorX q = state.q.cast<Extended>(), v = state.v.cast<Extended>(), tau = state.tau.cast<Extended>();
    MatrixXd result(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      auto at = [&](int steps) {
        VectorX moved = by_velocities ? v : q;
        moved[j] += Extended(steps) * h;
        return by_velocities ? accelerations(q, moved, tau) : accelerations(moved, v, tau);
      };
      const VectorX column = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
      result.col(j) = column.cast<double>();
    }
    return result;
  }

private:
  ModelTpl<Extended> model;
  DataTpl<Extended> data;
  VectorX damping;
};

/// What is timed.
class Subject {
public:
  Subject(const Robot &robot, const std::vector<State> &all) : robot(robot), data(robot.model) {
    for (const State &state : all) inputs.push_back(robot.floating ? flying(state) : state);
  }

  const VectorXd &accelerations(const State &state, Convention convention) {
    torque = state.tau - robot.damping.cwiseProduct(state.v);
    return aba(robot.model, data, state.q, state.v, torque, convention);
  }

  void derivatives(const State &state) {
    torque = state.tau - robot.damping.cwiseProduct(state.v);
    computeABADerivatives(robot.model, data, state.q, state.v, torque);
    // Only the upper triangle of the inverse is filled.
    for (Eigen::Index j = 0; j < robot.damping.size(); ++j)
      if (robot.damping[j] != 0.0)
        for (Eigen::Index i = 0; i < robot.damping.size(); ++i)
          data.ddq_dv(i, j) -= data.Minv(std::min(i, j), std::max(i, j)) * robot.damping[j];
  }

  const Robot &robot;
  Data data;
  std::vector<State> inputs;

private:
  VectorXd torque;
};

double sink = 0.0;

/// The fastest of many passes over all states, for one of them [ns].
template <class Evaluate> double fastest(std::size_t count, double seconds, Evaluate evaluate) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  double best = std::numeric_limits<double>::infinity();
  do {
    const auto start = Clock::now();
    for (std::size_t i = 0; i < count; ++i) evaluate(i);
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  } while (std::chrono::duration<double>(Clock::now() - begin).count() < seconds);
  return best / double(count);
}

void tell(const MatrixXd &matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) std::printf("%.17g ", matrix(i, j));
}

void demand(double apart, double scale, const char *what) {
  // Doubles of one algorithm against extended precision: a million roundings.
  if (!(apart <= 1e-10 * scale)) throw std::runtime_error(std::string("Pinocchio disagrees with itself: ") + what);
}

/// What is timed gives the values that are told.
void check(Subject &subject, Reference &reference, const std::vector<State> &all, bool derivatives) {
  const Eigen::Index n = all[0].q.size(), base = subject.robot.floating ? 6 : 0, joints = n - base;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const State &state = all[i];
    const VectorX told = reference.accelerations(state.q.cast<Extended>(), state.v.cast<Extended>(),
                                                 state.tau.cast<Extended>());
    const VectorXd expected = told.cast<double>();
    for (const Convention convention : {Convention::LOCAL, Convention::WORLD}) {
      const VectorXd found = subject.accelerations(subject.inputs[i], convention);
      const double scale = expected.cwiseAbs().maxCoeff();
      demand((found - expected).tail(joints).cwiseAbs().maxCoeff(), scale, "accelerations");
      if (base > 0) {
        Eigen::Matrix3d rotation, rates;
        turn(state.q, rotation, rates);
        const auto &v = subject.inputs[i].v;
        const Eigen::Vector3d turning = v.segment<3>(3), moving = v.head<3>();
        const Eigen::Vector3d shift = rotation * (found.head<3>() + turning.cross(moving));
        demand((shift - expected.head<3>()).cwiseAbs().maxCoeff(), scale, "acceleration of the base");
      }
    }
    if (derivatives) {
      subject.derivatives(subject.inputs[i]);
      for (const bool by_velocities : {false, true}) {
        const MatrixXd &all_found = by_velocities ? subject.data.ddq_dv : subject.data.ddq_dq;
        const MatrixXd expected = reference.derivatives(state, by_velocities).bottomRightCorner(joints, joints);
        const double scale = expected.cwiseAbs().maxCoeff();
        const MatrixXd found = all_found.bottomRightCorner(joints, joints);
        demand((found - expected).cwiseAbs().maxCoeff(), scale, "derivatives");
      }
    }
  }
}

int main(int count, char **arguments) {
  if (count != 3) {
    std::cerr << "usage: pinocchio MODEL STATES\n";
    return 2;
  }
  try {
    const Robot timed = load(arguments[1], Base::quaternion), told = load(arguments[1], Base::angles);
    const auto all = states(arguments[2], told.model.nv);
    Subject subject(timed, all);
    Reference reference(told);
    std::string line;
    while (std::getline(std::cin, line)) {
      std::istringstream request(line);
      std::string verb, what;
      double seconds = 0.0;
      request >> verb >> what >> seconds;
      if (verb == "evaluate") {
        check(subject, reference, all, what == "derivatives");
        for (const State &state : all) {
          if (what == "accelerations") {
            const VectorX a = reference.accelerations(state.q.cast<Extended>(), state.v.cast<Extended>(),
                                                      state.tau.cast<Extended>());
            tell(a.cast<double>());
          } else {
            tell(reference.derivatives(state, false));
            tell(reference.derivatives(state, true));
          }
        }
        std::printf("\n");
      } else if (what == "pinocchio-derivatives") {
        std::printf("%.6f\n", fastest(all.size(), seconds, [&](std::size_t i) {
                      subject.derivatives(subject.inputs[i]);
                      sink += subject.data.ddq_dq(0, 0);
                    }));
      } else {
        const auto convention = what == "pinocchio-aba" ? Convention::LOCAL : Convention::WORLD;
        std::printf("%.6f\n", fastest(all.size(), seconds, [&](std::size_t i) {
                      sink += subject.accelerations(subject.inputs[i], convention)[0];
                    }));
      }
      std::fflush(stdout);
    }
  } catch (const std::exception &error) {
    std::cerr << "pinocchio: " << error.what() << "\n";
    return 1;
  }
  // The compiler must not find out that nobody reads it.
  return sink == 0.123456789 ? 3 : 0;
}
