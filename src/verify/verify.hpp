// Checks an answer again, from the grasp alone: docs/certificate.md.
#pragma once

#include "ask/document.hpp"
#include "ask/document_reader.hpp"
#include "verify/verdict.hpp"

namespace poise::verify {

/// Checks all that the document of an answer claims of a grasp.
template <int Dim>
Verdict verify(const Grasp<Dim>& grasp, const AnyDocument<Dim>& document);

/// The same for an answer: HoldAnswer, BestAnswer, CurveAnswer or CapacityAnswer.
template <int Dim, class Answer>
Verdict verify(const Grasp<Dim>& grasp, const Answer& answer) {
  return verify<Dim>(grasp, AnyDocument<Dim>(claims_of(grasp, answer)));
}

/// The same for JSON.
/// @throws FileError where the document is not a result, lacks something or has it of a wrong type
Verdict verify(const GraspFile& file, const Document& result);

}  // namespace poise::verify
