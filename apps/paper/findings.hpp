// What checking the paper showed, each with the number that shows it.
#pragma once

#include <string>

#include "apps/paper/paper_disks.hpp"

namespace poise::study {

/// A page of markdown.
std::string findings(const PaperDisks& disks);

}  // namespace poise::study
