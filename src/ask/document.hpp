// Answers as JSON documents, for programs: docs/command-line.md. Nothing is solved here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ask/answer.hpp"
#include "ask/claims.hpp"
#include "files/grasp_file.hpp"

namespace poise {

/// What the document of an answer claims.
template <int Dim>
HoldDocument<Dim> claims_of(const Grasp<Dim>& grasp, const HoldAnswer<Dim>& answer);
template <int Dim>
BestDocument<Dim> claims_of(const Grasp<Dim>& grasp, const BestAnswer<Dim>& answer);
TurnDocument<2> claims_of(const Grasp<2>& grasp, const TurnAnswer<2>& answer);
TurnDocument<3> claims_of(const Grasp<3>& grasp, const TurnAnswer<3>& answer);
CurveDocument claims_of(const Grasp<2>& grasp, const CurveAnswer& answer);
template <int Dim>
CapacityDocument<Dim> claims_of(const Grasp<Dim>& grasp, const CapacityAnswer<Dim>& answer);
template <int Dim>
SturdyDocument<Dim> claims_of(const Grasp<Dim>& grasp, const SturdyAnswer<Dim>& answer);

/// A document in lines of readable length.
template <class Claims>
std::string text_of(Claims claims);
/// The JSON document of an answer, as above.
template <int Dim, class Answer>
std::string document(const Grasp<Dim>& grasp, const Answer& answer) {
  return text_of(claims_of(grasp, answer));
}
/// That of what was read.
template <int Dim>
std::string document(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                     const CheckAnswer<Dim>& answer);
/// The same for whatever was asked.
template <int Dim>
std::string document(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                     const AnswerTo<Dim>& answer) {
  return std::visit(
      [&]<class Own>(const Own& own) {
        if constexpr (std::is_same_v<Own, CheckAnswer<Dim>>)
          return document<Dim>(file, grasp, own);
        else
          return document(grasp, own);
      },
      answer.of);
}

/// One answer of many: that of the documents above, but without what proves it (duals, arcs, cuts),
/// minima beside the best ones, and what each contact does.
template <int Dim>
nlohmann::ordered_json summary(const Grasp<Dim>& grasp, const Posture<Dim>& posture);
template <int Dim>
nlohmann::ordered_json summary(const Grasp<Dim>& grasp, const Best<Dim>& best);

}  // namespace poise
