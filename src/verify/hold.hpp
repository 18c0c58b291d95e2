// One hold: forces that balance, and the proof that no others have less effort, or that there are
// none.
#pragma once

#include "verify/held.hpp"

namespace poise::verify {

/// What a hold says, for those who compare several.
struct HoldClaim {
  bool holdable{false};
  Vec up, dual;
  Real angle{0};  ///< theta in the plane [rad]
  Real effort{0};
  std::size_t scenario{0};
  std::string manner{};
  std::vector<std::size_t> loaded{};  ///< contacts that press
  bool slipping{true};                ///< all of these slip
};

/// Whether the centre of mass lies in the fork of the fingers; unclear within rounding.
enum class Fork { no, yes, unclear };

/// A vector of so many numbers, any finite ones.
Vec read_vector(const Field& field, Eigen::Index size);

/// Checks all that a hold claims. @param force_cap [weights]
/// @param least  whether it claims to be the least, too: rounding leaves that open where the weight
///               is the greatest, or the friction the least
HoldClaim check_hold(Claims& claims, const Held& held, const Field& hold, Real force_cap,
                     bool least = true);

Fork fork(const Held& held, const Load& load, const Vec& up);

}  // namespace poise::verify
