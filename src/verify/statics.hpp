// The grasp and the mathematics by which answers are checked, written out plainly, in the plane and
// in space alike: docs/certificate.md. Nothing here knows how answers are found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "poise/grasp.hpp"
#include "verify/verdict.hpp"

namespace poise::verify {

using Vec = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Mat = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Balance within this counts as balance: force / W and moment / (W L).
inline constexpr Real delta = 1e-12L;

/// Numbers of an answer.
template <int Size>
Vec real(const Eigen::Matrix<double, Size, 1>& numbers) {
  return numbers.template cast<Real>();
}

/// What a pad has beside its normal force.
struct RealPad {
  struct Point {
    Vec place;  ///< from the contact's position
    Real share{0};
  };
  /// A moment about an axis in the pad's plane, which moves the centre of pressure across it.
  struct Tilt {
    Vec axis;
    Real reach{0}, gyration{0};

    Real most() const { return reach > 0 ? reach / gyration : 0; }
  };
  std::vector<Point> points;
  std::vector<Tilt> tilts;
  Vec middle;  ///< the mean of the points by their shares, from the contact's position
};

/// A contact; its force is written along the normal, then along the tangents, and for a soft finger
/// there follows its moment about the normal, times friction / torsion. For a pad: along the
/// normal, along the tangents at each of its points, and the moments that move the centre of
/// pressure, over the gyration radius of its points.
struct RealContact {
  std::string finger;
  Vec position, normal;                           ///< the normal points inwards and has length 1
  Real friction{0}, least{0}, most{0}, share{1};  ///< least and most: of the normal force
  Real torsion{0};                                ///< [m], 0 for a hard finger
  Mat G;                                          ///< the wrench of such a force, about the origin
  std::optional<RealPad> pad{};

  bool is_soft() const { return !pad && G.cols() == 4; }
  /// Where the normal force acts; of a pad the middle.
  Vec middle() const { return pad ? Vec(position + pad->middle) : position; }
};

struct RealLoad {
  Real weight{0};
  Vec com;
  Vec fixed;  ///< a wrench about the origin
  Real lift{0};
  Vec acceleration;
  Real length{1};  ///< of the hand: it is about the com of the first load
  Real radius{0};  ///< of the farthest contact, or point of a pad, from the com

  Real turning() const;  ///< the force that turns with gravity
  Vec still() const;     ///< the wrench that does not, about the origin
  Real size() const;     ///< [N]
};

/// What moves fingers, and how far per unit of its speed.
struct RealDrive {
  struct Moved {
    std::string finger;
    Vec twist;
  };
  std::string name;
  std::vector<Moved> moves;
  Real max{0};  ///< may be infinite
  bool turns{false};
};

struct RealGrasp {
  int dim{2};
  std::vector<RealLoad> loads;
  std::vector<RealContact> contacts;
  std::vector<std::string> fingers;  ///< in the order of their first contact
  std::vector<Vec> closing;          ///< of the fingers; zero where it is not known
  std::vector<RealDrive> drives;     ///< none where fingers without a closing direction have them
  bool in_parts{false};              ///< grip is told in parts of the drives' max
  bool within_max{true};             ///< whether the drives' max limits what they give

  /// What the grip counts of a drive's effort as 1.
  Real unit(const RealDrive& drive) const { return in_parts ? drive.max : 1; }

  Real greatest_size() const;
};

template <int Dim>
RealGrasp real_grasp(const Grasp<Dim>& grasp);

/// The same contacts with one load.
RealGrasp with_load(RealGrasp grasp, const RealLoad& load);
/// The same contacts with all frictions and torsions multiplied by a factor.
RealGrasp with_friction(RealGrasp grasp, Real factor);

/// The wrench of a force at a point, about the origin.
Vec wrench(const Vec& force, const Vec& point);
/// The wrench that the contacts must supply.
Vec wrench(const RealLoad& load, const Vec& up);
/// The velocity of a point under the twist y, and the length of its angular velocity.
Vec velocity(const Vec& y, const Vec& point);
Real turning(const Vec& y);
/// Force / W and moment / (W L) of a wrench, the moment about the com: the larger.
Real relative_size(const Vec& wrench, const RealLoad& load);

/// What friction leaves to a force, at the point of a pad that has least left.
Real friction_left(const RealContact& contact, const Vec& force);
/// How far a force is outside of its friction cone and limits.
Real outside(const RealContact& contact, const Vec& force);
/// What a force counts in the effort.
Real effort(const RealContact& contact, const Vec& force);
/// How fast the contact slides, at the point of a pad that slides least.
Real sliding(const RealContact& contact, const Vec& z);
/// The most that a force with normal force 1 can do against z.
Real power(const RealContact& contact, const Vec& z);
/// The force in the friction cone, within its limits, of which z . f - effort / 2 is greatest.
Vec project(const RealContact& contact, const Vec& z);
/// The greatest z . f - effort / 2 of forces f in the cone, and for y the sum over contacts.
Real phi(const RealContact& contact, const Vec& z);
Real phi(const RealGrasp& grasp, const Vec& y);
/// 2 (y . w - phi(G^T y)): no forces that balance w have less effort.
Real bound(const RealGrasp& grasp, const Vec& w, const Vec& y);
/// y less what drives with these rates move of a finger.
Vec against(const RealGrasp& grasp, const std::string& finger, const Vec& y,
            const std::vector<Real>& rates);
/// 2 (y . w - sum rate max - phi): what y and rates of limited drives prove of the effort.
Real bound(const RealGrasp& grasp, const Vec& w, const Vec& y, const std::vector<Real>& rates);
/// What y and rates prove of the grip: y . w, less what contacts can do against them; of those
/// without a limit with forces of at most `cap` [N].
Real grip_bound(const RealGrasp& grasp, const Vec& w, const Vec& y, const std::vector<Real>& rates,
                Real cap);
/// How far rounding may take the bound on the effort: a long y leaves it few digits.
Real bound_rounding(const RealGrasp& grasp, const Vec& w, const Vec& y,
                    const std::vector<Real>& rates);
/// |v| + L |omega| times the weight, v at the com: the power of y on an imbalance of 1 at most.
Real imbalance_power(const RealLoad& load, const Vec& y);

/// What forces within the limits do against (y, rates) at most: of contacts without a limit as much
/// as the force norm allows.
struct PowerBound {
  Real limited{0}, per_norm{0};
};
PowerBound power_bound(const RealGrasp& grasp, const Vec& y, const std::vector<Real>& rates);

/// weight * gain <= fixed for every weight that is held in a posture with a force norm of at most
/// `cap` weights, balanced within delta.
struct WeightBound {
  Real gain{0}, fixed{0};
};
WeightBound weight_bound(const RealGrasp& grasp, const RealLoad& load, const Vec& up, const Vec& y,
                         const std::vector<Real>& rates, Real cap);

}  // namespace poise::verify
