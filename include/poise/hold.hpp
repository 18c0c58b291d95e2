// The least contact forces that balance a load, with their proof: docs/theory.md, "One posture".
#pragma once

#include "poise/posture.hpp"
#include "poise/small_vector.hpp"

namespace poise {

/// What a contact does. Slipping: it uses all its friction, friction_used >= 1 - 1e-9.
enum class ContactState : unsigned char { unloaded, sticking, slipping };
/// Which limit of its normal force a contact is at, within 1e-9 of the weight.
enum class ForceLimit : unsigned char { none, min, max };
/// The name of the value: "slipping".
const char* to_string(ContactState state);
const char* to_string(ForceLimit limit);

/// The force of a finger on the object at one contact.
template <int Dim>
struct ContactForce;

/// In the plane, in the contact frame.
template <>
struct ContactForce<2> {
  double normal;      ///< along the inward normal [N], >= 0
  double tangential;  ///< along the normal turned by +90 degrees [N]
  /// tangential / (friction * normal), 0 to 1; 1 for a loaded frictionless contact, 0 for an
  /// unloaded one.
  double friction_used;
  ContactState state;
  ForceLimit limit;
};

/// In space: the tangential force is a vector in the object frame.
template <>
struct ContactForce<3> {
  double normal;          ///< along the inward normal [N], >= 0
  Vector<3> tangential;   ///< tangent to the contact, object frame [N]
  double torsion_moment;  ///< of a soft finger, about the inward normal [N m]
  /// sqrt(|tangential|^2 + (torsion_moment friction / torsion)^2) / (friction * normal), 0 to 1; 1
  /// for a loaded frictionless contact, 0 for an unloaded one.
  double friction_used;
  ContactState state;
  ForceLimit limit;
};

/// What still counts as a hold.
struct HoldSettings {
  double force_cap{1e6};  ///< [weights]: a load that needs a greater force norm is unholdable
};

/// The least contact forces in one posture, or the proof that the object cannot be held.
template <int Dim>
struct Hold {
  bool holdable{false};
  /// Where unholdable: whether lower_bound is above the cap. Within rounding of the limit of
  /// holding there may be neither forces nor a proof.
  bool proven{true};
  /// V = sum |f_i|^2 / share_i [N^2]; 0 where unholdable. Moments of soft fingers count in f_i.
  double effort{0};
  /// Optimal dual y, a twist about the object frame's origin [N, N/m].
  /// Proof: V >= lower_bound = 2 (y . w - phi(G^T y)) for every force that balances w. Where
  /// unholdable, the same with w moved by the balance tolerance: lower_bound > force_cap^2.
  Twist<Dim> dual = Twist<Dim>::Zero();
  double lower_bound{0};  ///< on the effort, by `dual` [N^2]
  double residual{0};     ///< balance error: the larger of force / W and moment / (W L)
  SmallVector<ContactForce<Dim>, 16> forces;  ///< one for each contact; empty where unholdable
};

/// The hold of least effort in the posture `up` (unit vector against gravity, object frame).
///
/// Minimises sum |f_i|^2 / share_i over forces in the friction cones that balance the weight:
/// the paper's evaluation function (12), for any contacts. Allocates nothing up to 16 contacts.
template <int Dim>
Hold<Dim> hold(const Grasp<Dim>& grasp, const Vector<Dim>& up, const HoldSettings& settings = {});

/// The same for any load (the wrench that the contacts must supply, about the object frame's
/// origin), started at a twist y that was optimal for a load nearby.
template <int Dim>
Hold<Dim> hold(const Grasp<Dim>& grasp, const Wrench<Dim>& load, const Twist<Dim>& y,
               const HoldSettings& settings = {});

/// What one finger does with all its contacts.
template <int Dim>
struct FingerForce {
  double normal{0};                         ///< sum of the normal forces [N]
  Vector<Dim> force = Vector<Dim>::Zero();  ///< on the object, object frame [N]
};

/// The forces of the fingers, in the order of grasp.fingers(). Empty where unholdable.
template <int Dim>
std::vector<FingerForce<Dim>> finger_forces(const Grasp<Dim>& grasp, const Hold<Dim>& hold);

/// How hard the hardest pressing finger presses: the largest normal force of a finger [N].
template <int Dim>
double grip_force(const Grasp<Dim>& grasp, const Hold<Dim>& hold);

/// Whether every finger's normal force is above 1e-9 of the weight.
template <int Dim>
bool all_loaded(const Grasp<Dim>& grasp, const Hold<Dim>& hold);

/// How the object is held in the posture `up` by these forces.
Manner manner(const Grasp<2>& grasp, const Vector<2>& up, const Hold<2>& hold);
Manner manner(const Grasp<3>& grasp, const Vector<3>& up, const Hold<3>& hold);

/// Why an unholdable load cannot be held, in words: the motion that it drives and no contact
/// opposes ("it would turn clockwise about (0.1, 0) m").
std::string reason(const Grasp<2>& grasp, const Hold<2>& hold);
/// In space also "it would turn about the line through contacts 0 and 1".
std::string reason(const Grasp<3>& grasp, const Hold<3>& hold);

/// Whether the contacts, without force limits, can balance any wrench at all.
template <int Dim>
bool force_closure(const Grasp<Dim>& grasp);

}  // namespace poise
