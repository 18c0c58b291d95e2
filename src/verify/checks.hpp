// What checks the documents of each command, and single holds.
#pragma once

#include <optional>

#include "ask/claims.hpp"
#include "verify/statics.hpp"

namespace poise::verify {

/// How the grasp file says that the object is held now.
struct Present {
  bool known{false};        ///< whether there is a file
  std::optional<Vec> up{};  ///< none where the file does not say
};

/// Checks that options are those of a command, and that the program accepts them.
void check_options(Verdict& verdict, int dim, const OptionsClaim& options,
                   const std::vector<std::string_view>& needed,
                   const std::vector<std::string_view>& possible = {});
/// The posture that was asked for.
std::optional<Vec> asked_up(const OptionsClaim& options);
void check_up(Verdict& verdict, const Path& place, const Vec& up, const Vec& expected,
              const std::string& words);

void check_curve(Verdict& verdict, const RealGrasp& grasp, const CurveDocument& curve);
void check_best(Verdict& verdict, const RealGrasp& grasp, const BestDocument<2>& best);
void check_best(Verdict& verdict, const RealGrasp& grasp, const BestDocument<3>& best);
/// Checks the turns that a best posture comes with.
void check_turns(Verdict& verdict, const Grasp<2>& given, const RealGrasp& grasp,
                 const BestDocument<2>& best);
void check_turns(Verdict& verdict, const Grasp<3>& given, const RealGrasp& grasp,
                 const BestDocument<3>& best);
void check_turn_document(Verdict& verdict, const Grasp<2>& given, const RealGrasp& grasp,
                         const TurnDocument<2>& turn);
void check_turn_document(Verdict& verdict, const Grasp<3>& given, const RealGrasp& grasp,
                         const TurnDocument<3>& turn);
template <int Dim>
void check_capacity(Verdict& verdict, const RealGrasp& grasp, const CapacityDocument<Dim>& capacity,
                    const Present& present);
/// Checks what is withstood besides the load.
template <int Dim>
void check_shakes(Verdict& verdict, const Grasp<Dim>& given, const CapacityDocument<Dim>& capacity);
template <int Dim>
void check_sturdy(Verdict& verdict, const Grasp<Dim>& given, const RealGrasp& grasp,
                  const SturdyDocument<Dim>& sturdy);

/// Checks that forces hold the object within the force cap [weights], or the proof that none do.
template <int Dim>
void check_hold(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                const HoldClaim<Dim>& hold, Real force_cap);
/// Checks also that no forces have less effort. At the limit of what can be held forces for a load
/// within the tolerance of the balance may need less than dual proves.
template <int Dim>
void check_least_hold(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                      const HoldClaim<Dim>& hold, Real force_cap, bool at_limit = false);

/// Checks that what is told of a contact follows from its force, and returns that force as G takes
/// it.
template <int Dim>
Vec check_contact(Verdict& verdict, const Path& place, const RealContact& contact, Real weight,
                  const ContactClaim<Dim>& claim);

/// What is least in a hold: the effort or the grip.
template <int Dim>
Real value(const HoldClaim<Dim>& hold) {
  return hold.objective == Objective::grip ? hold.grip.value_or(0) : hold.effort;
}

/// Differences of values below this are rounding: a grip may be 0 where the weight is not, an
/// effort may not.
Real little(const RealGrasp& grasp, std::optional<Objective> objective);
/// |a - b| relative to the larger, or to what is little.
Real difference(Real a, Real b, Real little);
/// Rates that a document gives, where they can be those of the grasp's drives.
std::optional<std::vector<Real>> real_rates(Verdict& verdict, const Path& place,
                                            const RealGrasp& grasp,
                                            const std::optional<std::vector<double>>& rates);

/// The load of which an answer gives the number; the first where there is no such one.
const RealLoad& load_of(Verdict& verdict, const Path& place, const RealGrasp& grasp,
                        std::size_t load);
/// Up where the file does not say how the object is held.
Vec upright(int dim);

inline constexpr Real rounding = 1e-12L;  ///< of a number that follows from others in the document
inline constexpr Real at_limit = 1e-9L;   ///< of the weight, and of the friction
/// Whether a number is beside a limit by no more than rounding.
bool is_beside(Real number, Real limit, Real unit);

}  // namespace poise::verify
