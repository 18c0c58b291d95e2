// Answers as JSON documents, for programs: docs/command-line.md. Nothing is solved here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ask/answer.hpp"
#include "files/grasp_file.hpp"

namespace poise {

/// An answer to a question about a grasp: one JSON document in lines of readable length.
template <int Dim>
std::string document(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                     const CheckAnswer<Dim>& answer);
template <int Dim>
std::string document(const Grasp<Dim>& grasp, const HoldAnswer<Dim>& answer);
template <int Dim>
std::string document(const Grasp<Dim>& grasp, const BestAnswer<Dim>& answer);
std::string document(const Grasp<2>& grasp, const CurveAnswer& answer);
template <int Dim>
std::string document(const Grasp<Dim>& grasp, const CapacityAnswer<Dim>& answer);

/// One answer of many: that of the documents above, but without what proves it (duals, arcs, cuts),
/// minima beside the best ones, and what each contact does.
template <int Dim>
nlohmann::ordered_json summary(const Grasp<Dim>& grasp, const Posture<Dim>& posture);
template <int Dim>
nlohmann::ordered_json summary(const Grasp<Dim>& grasp, const Best<Dim>& best);

}  // namespace poise
