#include "readers/modules.hpp"

namespace poise::readers {

AcronymData read_acronym(const std::string& file);
void add_arrays(const std::string& file, const std::string& group,
                const std::vector<NamedArray>& arrays);

}  // namespace poise::readers

extern "C" const poise::DataModule poise_module{poise::readers::read_acronym,
                                                poise::readers::add_arrays};
