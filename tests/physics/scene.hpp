// A grasp in MuJoCo: a free body, and fingers that press on it with given normal forces. Friction
// is left to the simulator.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/grasp.hpp"

namespace poise::test::physics {

struct Free {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, Free>;
using Data = std::unique_ptr<mjData, Free>;

/// What a document says.
inline Model model_of(const std::string& xml) {
  mjVFS files;
  mj_defaultVFS(&files);
  const char* name = "scene.xml";
  mj_makeEmptyFileVFS(&files, name, static_cast<int>(xml.size()));
  std::memcpy(files.filedata[0], xml.data(), xml.size());
  char problem[1000] = "";
  Model model(mj_loadXML(name, &files, problem, sizeof problem));
  mj_deleteVFS(&files);
  if (!model) throw std::runtime_error(std::string(problem) + "\n" + xml);
  return model;
}

/// Numbers as documents have them.
inline std::string text(const Vector<3>& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x() << ' ' << v.y() << ' ' << v.z();
  return out.str();
}

/// What slides by itself: each contact, or all contacts of a finger, which have one normal, as one
/// rigid piece.
enum class Sliding { contacts, fingers };

/// A small ball for each contact, that slides along the inward normal alone, pressed on a flat pad
/// of the object at the contact's position. Only these pairs touch. The load acts on the object
/// alone, so that fingers weigh nothing.
class Scene {
 public:
  /// The centre of mass is the hand's center.
  /// @param weight         of the object [N]
  /// @param load           what the contacts must supply, about the object frame's origin
  /// @param normal_forces  one for each contact
  /// @param friction       what friction and torsion are multiplied by
  Scene(const Hand<3>& hand, double weight, const Wrench<3>& load,
        const std::vector<double>& normal_forces, double friction,
        Sliding sliding = Sliding::contacts)
      : hand_(hand),
        weight_(weight),
        sliding_(sliding),
        model_(model_of(document(normal_forces, friction))) {
    data_.reset(mj_makeData(model_.get()));
    const Vector<3> force = load.head<3>();
    const Vector<3> moment = load.tail<3>() - hand_.center().cross(force);
    for (int k = 0; k < 3; ++k) {
      data_->xfrc_applied[6 * object + k] = -force[k];
      data_->xfrc_applied[6 * object + 3 + k] = -moment[k];
    }
    std::ptrdiff_t motor = -1;
    for (std::size_t k = 0; k < normal_forces.size(); ++k) {
      if (!presses(normal_forces[k])) continue;
      if (begins_piece(k)) ++motor;
      data_->ctrl[motor] += normal_forces[k];
    }
  }
  /// Against the grasp's load in the posture `up`.
  Scene(const Grasp<3>& grasp, const Vector<3>& up, const std::vector<double>& normal_forces,
        double friction, Sliding sliding = Sliding::contacts)
      : Scene(grasp, grasp.size(), grasp.loads().front().at(up), normal_forces, friction, sliding) {
  }

  /// Presses for a while, after contact has been made with twice the friction, or the object would
  /// begin with a small fall. @return how far the centre of mass, or a point beside it at the
  /// distance of the farthest contact, has moved since [m]
  double moved(double seconds) {
    const std::ptrdiff_t numbers = std::ptrdiff_t{5} * model_->npair;
    const std::vector<mjtNum> friction(model_->pair_friction, model_->pair_friction + numbers);
    for (std::ptrdiff_t k = 0; k < numbers; ++k) model_->pair_friction[k] *= 2;
    const double contact_made = 0.02;
    while (data_->time < contact_made) mj_step(model_.get(), data_.get());
    std::copy(friction.begin(), friction.end(), model_->pair_friction);
    const Vector<3> before(data_->qpos);
    const Eigen::Quaterniond turned_before = turned();
    while (data_->time < contact_made + seconds) mj_step(model_.get(), data_.get());
    return (Vector<3>(data_->qpos) - before).norm() +
           turned().angularDistance(turned_before) * hand_.radius();
  }

 private:
  static constexpr int object = 1;  // body 0 is the world
  static constexpr double ball = 0.01, pad = 0.05, gravity = standard_gravity;

  /// The object's orientation: after its position.
  Eigen::Quaterniond turned() const {
    const mjtNum* q = data_->qpos + 3;
    return {q[0], q[1], q[2], q[3]};
  }

  /// Contacts of a finger follow each other.
  bool begins_piece(std::size_t k) const {
    return sliding_ == Sliding::contacts || k == 0 || hand_.finger_of(k) != hand_.finger_of(k - 1);
  }

  bool presses(double normal_force) const { return normal_force > 1e-9 * weight_; }

  std::string document(const std::vector<double>& normal_forces, double friction) const {
    const Vector<3> com = hand_.center();
    const double mass = weight_ / gravity;
    const double inertia = 0.4 * mass * hand_.radius() * hand_.radius();
    std::ostringstream pads, fingers, pairs, motors;
    for (std::ostringstream* out : {&pads, &fingers, &pairs, &motors}) out->precision(17);
    for (std::size_t k = 0; k < hand_.contacts().size(); ++k) {
      if (!presses(normal_forces[k])) continue;
      const Contact<3>& c = hand_.contacts()[k];
      const Vector<3>& n = c.normal;
      pads << "<geom name='pad" << k << "' type='box' size='" << pad << ' ' << pad << ' ' << pad
           << "' pos='" << text(c.position + pad * n - com) << "' zaxis='" << text(n)
           << "' contype='0' conaffinity='0'/>\n";
      // A micrometre inside the pad, so that they touch from the first step.
      if (begins_piece(k))
        fingers << (fingers.str().empty() ? "" : "</body>\n") << "<body><joint name='slide" << k
                << "' type='slide' axis='" << text(n) << "'/>\n";
      fingers << "<geom name='ball" << k << "' pos='" << text(c.position - (ball - 1e-6) * n)
              << "' type='sphere' size='" << ball << "' mass='" << normal_forces[k] / gravity
              << "' contype='0' conaffinity='0'/>\n";
      const double mu = friction * c.friction;
      pairs << "<pair geom1='pad" << k << "' geom2='ball" << k << "' condim='"
            << (mu == 0         ? 1
                : c.torsion > 0 ? 4
                                : 3)
            << "' friction='" << mu << ' ' << mu << ' ' << friction * c.torsion
            << " 0 0' margin='0' solref='0.001 1' "
            << "solimp='0.99 0.99 0.001'/>\n";
      if (begins_piece(k)) motors << "<motor joint='slide" << k << "'/>\n";
    }
    std::ostringstream xml;
    xml.precision(17);
    xml << "<mujoco><option timestep='1e-4' gravity='0 0 0' cone='elliptic' impratio='1000' "
           "solver='Newton' iterations='100' tolerance='1e-12'/>\n<worldbody><body pos='"
        << text(com) << "'><freejoint/><inertial pos='0 0 0' mass='" << mass << "' diaginertia='"
        << inertia << ' ' << inertia << ' ' << inertia << "'/>\n"
        << pads.str() << "</body>\n"
        << fingers.str() << (fingers.str().empty() ? "" : "</body>") << "</worldbody>\n<contact>"
        << pairs.str() << "</contact>\n<actuator>" << motors.str() << "</actuator></mujoco>\n";
    return xml.str();
  }

  Hand<3> hand_;
  double weight_;
  Sliding sliding_;
  Model model_;
  Data data_;
};

}  // namespace poise::test::physics
