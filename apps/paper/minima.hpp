// The minima of disks, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "apps/paper/paper_disks.hpp"
#include "tables/table.hpp"

namespace poise::study {

std::string minima_table(const std::vector<NamedDisk>& disks, const Style& style);

/// The same as JSON, with what was asked for.
std::string minima_document(const std::string& out, const GivenDisk& asked,
                            const std::vector<NamedDisk>& disks);

}  // namespace poise::study
