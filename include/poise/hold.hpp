// The least contact forces that balance a load, with their proof: docs/theory.md, "One posture".
#pragma once

#include <string>
#include <vector>

#include "poise/grasp.hpp"
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
  double torsion_moment;  ///< of a soft finger or a pad, about the inward normal [N m]
  /// sqrt(|tangential|^2 + (torsion_moment friction / torsion)^2) / (friction * normal), 0 to 1; 1
  /// for a loaded frictionless contact, 0 for an unloaded one.
  /// Of a pad: the sum over its points of |tangential| / (friction * normal).
  double friction_used;
  ContactState state;
  ForceLimit limit;
  /// Of a pad: where N acts, from the contact's position, object frame [m]. Of others zero.
  Vector<3> center_of_pressure;
};

/// What is to be least.
enum class Objective {
  grip,    ///< the greatest effort of the drives: what to command
  effort,  ///< the sum of squares of the contact forces, the paper's (12)
};
/// The name of the value: "grip".
const char* to_string(Objective objective);

/// What still counts as a hold.
struct HoldSettings {
  double force_cap{1e6};  ///< [weights]: a load that needs a greater force norm is unholdable
  Objective objective{Objective::effort};  ///< what the forces are to be least in
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
  /// The tangential force of each point of each pad, in the order of contacts and points [N, object
  /// frame]; empty without pads.
  std::vector<Vector<3>> pad_forces;
  Objective objective{Objective::effort};  ///< in which the forces are least, and lower_bound is
  double grip{0};                          ///< of objective grip: F of the forces [grip_unit()]
  /// Of the drives, >= 0, where they say something: docs/theory.md, (9) and (10).
  SmallVector<double, 4> rates;

  /// What is least: V or F.
  double value() const { return objective == Objective::grip ? grip : effort; }
};

/// The hold of least effort in the posture `up` (unit vector against gravity, object frame),
/// against the load that needs most.
///
/// Minimises sum |f_i|^2 / share_i over forces in the friction cones that balance the load:
/// the paper's evaluation function (12), for any contacts. Allocates nothing up to 16 contacts,
/// but for pads and limits of drives. With objective grip it is least_grip() within the drives'
/// max.
/// @throws InvalidGrasp where `up` is no unit vector or the force cap is out of its range
template <int Dim>
Hold<Dim> hold(const Grasp<Dim>& grasp, const Vector<Dim>& up, const HoldSettings& settings = {});

/// The same for one load.
template <int Dim>
Hold<Dim> hold(const Hand<Dim>& hand, const Load<Dim>& load, const Vector<Dim>& up,
               const HoldSettings& settings = {});

/// The same for any wrench that the contacts must supply (about the object frame's origin), started
/// at a twist y that was optimal for a wrench nearby. `weight` [N] is the unit of the force cap and
/// of the balance tolerance.
template <int Dim>
Hold<Dim> hold(const Hand<Dim>& hand, const Wrench<Dim>& load, double weight, const Twist<Dim>& y,
               const HoldSettings& settings = {});

/// phi(G^T y) [N^2] of a twist y about the object frame's origin [N, N/m]: half the sum of the
/// squares of the forces to which G^T y projects, where nothing limits them.
/// The greatest value of f . G^T y - |f|^2 / 2 over all f in the cones.
template <int Dim>
double phi(const Hand<Dim>& hand, const Twist<Dim>& y);

/// What a twist y (about the object frame's origin [N, N/m]) proves of a load [N, N m]:
/// V >= 2 (y . load - phi(G^T y)), whatever y is. On this every proof rests: docs/theory.md, (3).
template <int Dim>
double bound(const Hand<Dim>& hand, const Wrench<Dim>& load, const Twist<Dim>& y);

/// What one finger does with all its contacts.
template <int Dim>
struct FingerForce {
  double normal{0};  ///< sum of the normal forces [N]
  /// The part of the force along the closing direction [N]; 0 where there is none.
  double pressing{0};
  Vector<Dim> force = Vector<Dim>::Zero();  ///< on the object, object frame [N]
};

/// The force on the object at a contact, object frame [N].
Vector<2> force_vector(const Contact<2>& contact, const ContactForce<2>& force);
Vector<3> force_vector(const Contact<3>& contact, const ContactForce<3>& force);

/// The forces of the fingers, in the order of hand.fingers(). Empty where unholdable.
template <int Dim>
std::vector<FingerForce<Dim>> finger_forces(const Hand<Dim>& hand, const Hold<Dim>& hold);

/// Whether every finger's normal force is above 1e-9 of the weight [N].
template <int Dim>
bool all_loaded(const Hand<Dim>& hand, const Hold<Dim>& hold, double weight);

/// Why an unholdable load cannot be held, in words: the motion that it drives and no contact
/// opposes ("it would turn clockwise about (0.1, 0) m"); in space also "it would turn about the
/// line through contacts 0 and 1".
std::string reason(const Hand<2>& hand, const Hold<2>& hold);
std::string reason(const Hand<3>& hand, const Hold<3>& hold);

/// Whether the contacts, without force limits, can balance any wrench at all.
template <int Dim>
bool force_closure(const Hand<Dim>& hand);

}  // namespace poise
