#include "readers/modules.hpp"

namespace poise::readers {

AcronymData read_acronym(const std::string& file);

}  // namespace poise::readers

extern "C" const poise::DataModule poise_module{poise::readers::read_acronym};
