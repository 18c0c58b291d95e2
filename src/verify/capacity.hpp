// What a gripper can hold: both sides of each limit.
#pragma once

#include "verify/held.hpp"

namespace poise::verify {

void check_capacity(Claims& claims, const Held& held, const Field& root);

}  // namespace poise::verify
