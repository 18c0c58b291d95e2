// A question about a grasp, answered. Here program, page, Python and batch meet the solvers.
#pragma once

#include <stdexcept>
#include <string>

#include "ask/answer.hpp"
#include "ask/question.hpp"
#include "files/grasp_file.hpp"

namespace poise {

/// A question that makes no sense for this grasp. Who asked says so in words of their own.
class Misfit : public std::invalid_argument {
 public:
  /// what() is "option: problem the grasp file".
  Misfit(const std::string& option, const std::string& problem, int dimension)
      : std::invalid_argument(option + ": " + problem + " the grasp file"),
        option_(option),
        problem_(problem),
        dimension_(dimension) {}
  const std::string& option() const noexcept { return option_; }    ///< "up", or the command
  const std::string& problem() const noexcept { return problem_; }  ///< "is for space,"
  /// Of the grasp, where that is what does not fit; else 0: the file lacks something.
  int dimension() const noexcept { return dimension_; }

 private:
  std::string option_, problem_;
  int dimension_;
};

/// The answer. Options that the command does not take are not looked at.
/// @throws Misfit, and InvalidGrasp for settings out of their ranges
AnswerTo<2> ask(const PlanarFile& file, const Grasp<2>& grasp, const Question& question);
AnswerTo<3> ask(const SpatialFile& file, const Grasp<3>& grasp, const Question& question);

/// Whether the object can be held: `best` and `curve` somewhere, `capacity` in one of its postures;
/// `check` does not ask.
template <int Dim>
bool holdable(const AnswerTo<Dim>& answer);
/// Whether that it cannot be held is proven, where it is not holdable().
template <int Dim>
bool proven(const AnswerTo<Dim>& answer);

/// A posture to look at, and which one it is: given, now (that of the file), best or upright.
template <int Dim>
struct NamedPosture {
  std::string name;
  Posture<Dim> posture;
};

/// The first of these that there is. Only then is the best one sought.
/// @throws Misfit
NamedPosture<2> posture_to_show(const PlanarFile& file, const Grasp<2>& grasp,
                                const Question& question);
NamedPosture<3> posture_to_show(const SpatialFile& file, const Grasp<3>& grasp,
                                const Question& question);

}  // namespace poise
