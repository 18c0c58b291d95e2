// What reports of the plane and of space have in common.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "poise/best_posture.hpp"
#include "poise/grip.hpp"
#include "tables/table.hpp"

namespace poise {

std::string title(const std::string& name, const Style& style);
std::string heading(const std::string& text, const Style& style);

/// A posture in words: "20.00°", "(0.000, 0.000, 1.000)".
std::string posture_text(const Vector<2>& up);
std::string posture_text(const Vector<3>& up);
/// Where it is held: "At 20.00°", "With (0.000, 0.000, 1.000) up".
std::string place_text(const Vector<2>& up);
std::string place_text(const Vector<3>& up);

/// "from -30.00° to 30.00°", "in every posture"
std::string range_text(const Interval& interval);
/// "at most 30.00° from (0.000, 0.000, 1.000)"
std::string tilt_text(const Tilt& tilt);

/// The grip against any of the loads [grip_unit()]; nothing where the hand has none.
template <int Dim>
std::optional<double> grip_of(const Grasp<Dim>& grasp, const Posture<Dim>& posture) {
  if (!has_grip(grasp)) return {};
  double most = 0;
  for (const Hold<Dim>& hold : posture.holds) most = std::max(most, grip(grasp, hold));
  return most;
}

/// Whether a posture needs no more than another, but for a tie.
template <int Dim>
bool ties_with(const Posture<Dim>& posture, const Posture<Dim>& best) {
  constexpr double tie = 1e-6;
  return posture.value() <= best.value() * (1 + tie);
}

/// Why it cannot be held, and against which load.
template <int Dim>
std::string reason_text(const Grasp<Dim>& grasp, const Posture<Dim>& posture);
/// Why nothing holds: what the best posture asks of contacts and drives without their max, if there
/// is one; else the reason of an example.
template <int Dim>
std::string why_nowhere(const Grasp<Dim>& grasp, const std::optional<Posture<Dim>>& example,
                        const std::optional<Posture<Dim>>& without_max = {});

/// What a load is called, or its number: "load 1".
template <int Dim>
std::string load_name(const Grasp<Dim>& grasp, std::size_t load) {
  const std::string& name = grasp.loads()[load].name;
  return name.empty() ? "load " + std::to_string(load) : name;
}
/// ", against lifting", or nothing where there is but one.
template <int Dim>
std::string load_text(const Grasp<Dim>& grasp, std::size_t load) {
  return grasp.loads().size() == 1 ? "" : ", against " + load_name(grasp, load);
}
/// What a load has beside its weight: "lift 3 m/s², force (0, 0, -40) N"; nothing where it has not.
template <int Dim>
std::string acting_text(const Load<Dim>& load);

/// A line of a summary: which posture, what it needs least of, and how to get there.
template <int Dim>
void add_posture(Table& table, const std::string& which, const Grasp<Dim>& grasp,
                 const Posture<Dim>& posture, const std::string& how);

/// Forces by contact, and by finger where a finger has several contacts.
template <int Dim>
std::string forces_table(const Grasp<Dim>& grasp, const Hold<Dim>& hold, const Style& style);

/// "2.125 N", "0.55 N m" or "27.5 % of max".
template <int Dim>
std::string grip_text(const Grasp<Dim>& grasp, double grip);

/// "grip 2.125 N", or where the hand has none "force norm 8.966 N".
template <int Dim>
std::string least_text(const Grasp<Dim>& grasp, const Posture<Dim>& posture);

/// What the drives do; nothing where each finger has a drive of its own without max.
template <int Dim>
std::string drives_table(const Grasp<Dim>& grasp, const Hold<Dim>& hold, const Style& style);

/// What each load needs in a posture, those that need most where there are many; nothing where
/// there is but one.
template <int Dim>
std::string loads_table(const Grasp<Dim>& grasp, const Posture<Dim>& posture,
                            const Style& style);

/// A line of a table of optima.
struct OptimumRow {
  std::string posture;
  std::optional<double> grip;
  double effort;
  std::vector<std::string> words;  ///< manner, and what else there is to say
};
/// `words` are the headings of the words.
template <int Dim>
std::string optima_table(const Grasp<Dim>& grasp, const std::vector<OptimumRow>& rows,
                         const std::vector<std::string>& words, const Style& style);

/// By which factor the best pinched posture costs more than the best, and why.
template <int Dim>
std::string why_pinching_costs(const Grasp<Dim>& grasp, const Posture<Dim>& best,
                               const Posture<Dim>& pinched);

/// Lengths in the unit that makes them easy to read.
struct Lengths {
  explicit Lengths(double radius)
      : per_metre(radius >= 1 ? 1 : 1000),
        decimals(decimals_for(radius * per_metre)),
        unit(radius >= 1 ? "m" : "mm") {}
  std::string text(double length) const { return fixed(per_metre * length, decimals); }
  template <class Point>
  std::string text(const Point& point) const {
    return vector_text(per_metre * point, decimals);
  }
  double per_metre;
  int decimals;
  std::string unit;
};

}  // namespace poise
