// What reports of the plane and of space have in common.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "files/grasp_file.hpp"
#include "table.hpp"

namespace poise {

std::string title(const std::string& name, const Style& style);
std::string heading(const std::string& text, const Style& style);

/// Forces by contact, and by finger where a finger has several contacts.
template <int Dim>
std::string forces_table(const Grasp<Dim>& grasp, const Hold<Dim>& hold, const Style& style);

/// What stands below the forces: force norm and effort.
std::string effort_text(double effort);

/// A line of a table of optima.
struct OptimumRow {
  std::string posture;
  double grip_force, effort;
  std::vector<std::string> words;  ///< manner, and what else there is to say
};
/// `words` are the headings of the words.
std::string optima_table(const std::vector<OptimumRow>& rows, const std::vector<std::string>& words,
                         const Style& style);

/// By which factor the best pinched posture costs more than the best, and why.
template <int Dim>
std::string why_pinching_costs(const Grasp<Dim>& grasp, const Hold<Dim>& best, Manner manner,
                               const Hold<Dim>& pinched);

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

/// The facts of `check` that both dimensions have, to which `facts` are added, and the contacts.
template <int Dim>
std::string check_text(const CommonFile<Dim>& file, const std::vector<Grasp<Dim>>& grasps,
                       const std::vector<std::vector<std::string>>& facts, const Style& style);

}  // namespace poise
