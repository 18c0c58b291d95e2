// Candidates, ranked, for people.
#pragma once

#include <string>
#include <vector>

#include "batch/candidates.hpp"
#include "tables/table.hpp"

namespace poise {

/// The first of them; how many there are more.
template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp, const Question& question,
                   const Candidates<Dim>& candidates,
                   const std::vector<RankedCandidate<Dim>>& ranked, const Style& style);

}  // namespace poise
