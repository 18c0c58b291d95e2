#include "readers/modules.hpp"

namespace poise::readers {

Inertial read_inertial(const std::string& urdf, const std::string& link);
std::unique_ptr<TriangleFinder> triangle_finder(const Mesh& mesh);

}  // namespace poise::readers

extern "C" const poise::MeshModule poise_module{poise::readers::read_inertial,
                                                poise::readers::triangle_finder};
