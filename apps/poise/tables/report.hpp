// Answers for people: newtons first, the effort after them. Nothing is solved here.
#pragma once

#include <string>

#include "ask/answer.hpp"
#include "files/grasp_file.hpp"
#include "tables/table.hpp"

namespace poise {

template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp, const CheckAnswer<Dim>& answer,
                   const Style& style);
template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp, const HoldAnswer<Dim>& answer,
                   const Style& style);
std::string report(const PlanarFile& file, const Grasp<2>& grasp, const BestAnswer<2>& answer,
                   const Style& style);
std::string report(const SpatialFile& file, const Grasp<3>& grasp, const BestAnswer<3>& answer,
                   const Style& style);
std::string report(const PlanarFile& file, const Grasp<2>& grasp, const TurnAnswer<2>& answer,
                   const Style& style);
std::string report(const SpatialFile& file, const Grasp<3>& grasp, const TurnAnswer<3>& answer,
                   const Style& style);
std::string report(const PlanarFile& file, const Grasp<2>& grasp, const CurveAnswer& answer,
                   const Style& style);
template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                   const CapacityAnswer<Dim>& answer, const Style& style);
template <int Dim>
std::string report(const FileOf<Dim>& file, const Grasp<Dim>& grasp,
                   const SturdyAnswer<Dim>& answer, const Style& style);

}  // namespace poise
