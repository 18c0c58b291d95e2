#include "files/grasp_document.hpp"
#include "files/text.hpp"

namespace poise {

GraspFile grasp_from_yaml(std::string text, const std::string& file) {
  return grasp_from(parse_yaml(std::move(text), file));
}

GraspFile read_grasp_file(const std::string& file) {
  return grasp_from_yaml(read_text(file), file_name(file));
}

}  // namespace poise
