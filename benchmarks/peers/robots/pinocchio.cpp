// Pinocchio on one robot: values to compare, and times.
//
//   pinocchio MODEL STATES
//
// MODEL is what `robots.py` writes: the joints of a model of Pinocchio. STATES has a count and coordinates,
// velocities and torques of each state, in the order of that model; a floating base has x, y, z and either yaw,
// pitch, roll or three parameters of its orientation. Requests come line by line: `evaluate accelerations`, `evaluate derivatives`, `time SUBJECT SECONDS`.
//
// A floating base is a free flyer with a quaternion, as everybody uses it. Values are converted to those of
// the coordinates of the description that they are compared with; times are without that.

#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
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
template <class T> using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T> using Vector6 = Eigen::Matrix<T, 6, 1>;
template <class T> using Matrix3 = Eigen::Matrix<T, 3, 3>;

/// The coordinates that a description has for a base.
enum class Base { none, angles, pose };

/// A model, and the damping of its joints.
struct Robot {
  Model model;
  VectorXd damping;
  Base base = Base::none;
};

template <class Matrix> void read(std::istream &in, Matrix &&entries) {
  for (Eigen::Index i = 0; i < entries.rows(); ++i)
    for (Eigen::Index j = 0; j < entries.cols(); ++j)
      if (!(in >> entries(i, j)))
        throw std::runtime_error("a number is missing");
}

JointModel joint(const std::string &kind, const Eigen::Vector3d &axis) {
  if (kind == "RX") return JointModelRX();
  if (kind == "RY") return JointModelRY();
  if (kind == "RZ") return JointModelRZ();
  if (kind == "PX") return JointModelPX();
  if (kind == "PY") return JointModelPY();
  if (kind == "PZ") return JointModelPZ();
  if (kind == "R") return JointModelRevoluteUnaligned(axis);
  if (kind == "P") return JointModelPrismaticUnaligned(axis);
  if (kind == "angles" || kind == "pose") return JointModelFreeFlyer();
  throw std::runtime_error("unknown joint " + kind);
}

Robot load(const char *path) {
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
    const auto index = robot.model.addJoint(parent, joint(kind, axis), placement, name);
    robot.model.appendBodyToJoint(index, Inertia(mass, centre, inertia));
    if (kind == "angles" || kind == "pose") {
      robot.base = kind == "pose" ? Base::pose : Base::angles;
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

/// a × b. That of Eigen conjugates complex numbers.
template <class T> Vector3<T> crossed(const Vector3<T> &a, const Vector3<T> &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a · b, likewise.
template <class T> T dotted(const Vector3<T> &a, const Vector3<T> &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The matrix of v ×.
template <class T> Matrix3<T> skew(const Vector3<T> &v) {
  Matrix3<T> matrix;
  matrix << T(0), -v[2], v[1], v[2], T(0), -v[0], -v[1], v[0], T(0);
  return matrix;
}

/// Yaw, pitch, roll; or modified Rodrigues parameters ρ = 4 tan(θ/4) n of a turn by θ about n.
template <class T> struct Turn {
  Base base;
  Vector3<T> numbers;

  /// 1/(1 + |ρ|²/16) = cos²(θ/4).
  T reciprocal() const { return T(1) / (T(1) + dotted<T>(numbers, numbers) / T(16)); }

  /// From the base to the world.
  Matrix3<T> rotation() const {
    using std::cos, std::sin;
    if (base == Base::pose) {
      // A quaternion (w, u).
      const T d = reciprocal(), w = T(2) * d - T(1);
      const Matrix3<T> across = skew<T>(numbers * (d / T(2)));
      return Matrix3<T>::Identity() + across * (T(2) * w) + across * across * T(2);
    }
    const T cy = cos(numbers[0]), sy = sin(numbers[0]), cp = cos(numbers[1]), sp = sin(numbers[1]);
    const T cr = cos(numbers[2]), sr = sin(numbers[2]);
    Matrix3<T> turned;
    turned << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, //
        sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,       //
        -sp, cp * sr, cp * cr;
    return turned;
  }

  /// The angular velocity in the base for the rates of the numbers.
  Matrix3<T> rates() const {
    using std::cos, std::sin;
    if (base == Base::pose) {
      const T d = reciprocal(), w = T(2) * d - T(1);
      const Vector3<T> u = numbers * (d / T(2));
      return (Matrix3<T>::Identity() * w - skew<T>(u) + u * numbers.transpose() / T(4)) * d;
    }
    const T cp = cos(numbers[1]), sp = sin(numbers[1]), cr = cos(numbers[2]), sr = sin(numbers[2]);
    Matrix3<T> matrix;
    matrix << -sp, T(0), T(1), cp * sr, cr, T(0), cp * cr, -sr, T(0);
    return matrix;
  }

  /// The derivative of `rates` in time, times the rates.
  Vector3<T> change(const Vector3<T> &v) const {
    using std::cos, std::sin;
    if (base == Base::pose) {
      const T d = reciprocal(), growth = dotted<T>(numbers, v) / T(8);
      const Vector3<T> turning = rates() * v;
      return numbers * (d * d * dotted<T>(v, v) / T(8)) - turning * (T(2) * d * growth);
    }
    const T cp = cos(numbers[1]), sp = sin(numbers[1]), cr = cos(numbers[2]), sr = sin(numbers[2]);
    const T yaw = v[0], pitch = v[1], roll = v[2];
    return {-yaw * pitch * cp, -pitch * roll * sr + yaw * roll * cr * cp - yaw * pitch * sr * sp,
            -pitch * roll * cr - yaw * roll * sr * cp - yaw * pitch * cr * sp};
  }
};

/// The velocity of a free flyer for those of a description.
template <class T> Vector6<T> flying(const Turn<T> &turn, const Vector6<T> &v) {
  Vector6<T> twist;
  twist << turn.rotation().transpose() * v.template head<3>(), turn.rates() * v.template tail<3>();
  return twist;
}

/// The accelerations of a description for those of a free flyer.
template <class T>
Vector6<T> angular(const Turn<T> &turn, const Vector6<T> &v, const Vector6<T> &accelerations) {
  const Vector6<T> twist = flying(turn, v);
  const Vector3<T> moving = twist.template head<3>(), turning = twist.template tail<3>();
  const Vector3<T> beside = accelerations.template tail<3>() - turn.change(v.template tail<3>());
  Vector6<T> result;
  result << turn.rotation() * (accelerations.template head<3>() + crossed<T>(turning, moving)),
      turn.rates().inverse() * beside;
  return result;
}

/// The same state of a free flyer.
State flying(Base base, const State &state) {
  const Turn<double> turn{base, state.q.segment<3>(3)};
  const Eigen::Quaterniond quaternion(turn.rotation());
  State result{VectorXd(state.q.size() + 1), state.v, state.tau};
  result.q << state.q.head<3>(), quaternion.coeffs(), state.q.tail(state.q.size() - 6);
  result.v.head<6>() = flying<double>(turn, state.v.head<6>());
  return result;
}

/// Accelerations of a description.
VectorXd described(Base base, const State &state, VectorXd accelerations) {
  const Vector6<double> flyer = accelerations.head<6>();
  const Turn<double> turn{base, state.q.segment<3>(3)};
  accelerations.head<6>() = angular<double>(turn, state.v.head<6>(), flyer);
  return accelerations;
}

/// Their derivatives by coordinates or by velocities, by the chain rule. The functions above are
/// differentiated by a step in the complex plane, which loses no digits.
MatrixXd described(Base base, const State &state, const Data &data, bool by_velocities) {
  using Complex = std::complex<double>;
  const Eigen::Index n = state.q.size();
  const double step = 1e-100;
  const Turn<double> turn{base, state.q.segment<3>(3)};
  MatrixXd result = by_velocities ? data.ddq_dv : data.ddq_dq;
  const Matrix3<double> turned = turn.rotation(), turning = turn.rates();
  // How the state of the free flyer follows the base, and how its accelerations follow that.
  for (Eigen::Index j = 0; j < n; ++j) {
    Turn<Complex> moved{base, turn.numbers.cast<Complex>()};
    Vector6<Complex> v = state.v.head<6>().cast<Complex>();
    VectorXd column = result.col(j);
    if (j < 6) {
      if (by_velocities)
        v[j] += Complex(0.0, step);
      else if (j >= 3)
        moved.numbers[j - 3] += Complex(0.0, step);
      column = data.ddq_dv.leftCols<6>() * (flying<Complex>(moved, v).imag() / step);
      if (!by_velocities && j < 3)
        column += data.ddq_dq.leftCols<3>() * turned.row(j).transpose();
      else if (!by_velocities)
        column += data.ddq_dq.middleCols<3>(3) * turning.col(j - 3);
    }
    Vector6<Complex> accelerations;
    for (Eigen::Index i = 0; i < 6; ++i) accelerations[i] = Complex(data.ddq[i], step * column[i]);
    column.head<6>() = angular<Complex>(moved, v, accelerations).imag() / step;
    result.col(j) = column;
  }
  return result;
}

/// What is timed.
class Subject {
public:
  Subject(const Robot &robot, const std::vector<State> &all) : robot(robot), data(robot.model) {
    for (const State &state : all) inputs.push_back(robot.base == Base::none ? state : flying(robot.base, state));
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

int main(int count, char **arguments) {
  if (count != 3) {
    std::cerr << "usage: pinocchio MODEL STATES\n";
    return 2;
  }
  try {
    const Robot robot = load(arguments[1]);
    const auto all = states(arguments[2], robot.model.nv);
    Subject subject(robot, all);
    std::string line;
    while (std::getline(std::cin, line)) {
      std::istringstream request(line);
      std::string verb, what;
      double seconds = 0.0;
      request >> verb >> what >> seconds;
      if (verb == "evaluate") {
        for (std::size_t i = 0; i < all.size(); ++i) {
          if (what == "accelerations") {
            const VectorXd &a = subject.accelerations(subject.inputs[i], Convention::LOCAL);
            tell(robot.base == Base::none ? VectorXd(a) : described(robot.base, all[i], a));
          } else {
            subject.derivatives(subject.inputs[i]);
            for (const bool by_velocities : {false, true}) {
              if (robot.base != Base::none)
                tell(described(robot.base, all[i], subject.data, by_velocities));
              else
                tell(by_velocities ? subject.data.ddq_dv : subject.data.ddq_dq);
            }
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
