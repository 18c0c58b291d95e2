#include <optional>
#include <vector>

#include "meshes/formats.hpp"
#include "meshes/numbers.hpp"
#include "meshes/polygons.hpp"
#include "meshes/words.hpp"

namespace poise {
namespace {

[[noreturn]] void fail(const std::string& problem) {
  throw ReadError("cannot be read: " + problem);
}

struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> length{};  ///< of a list: of the number of its values
};

struct Element {
  std::string name;
  unsigned long long count;
  std::vector<Property> properties{};
};

enum class Format { text, little, big };

struct Header {
  Format format{Format::text};
  std::vector<Element> elements{};
  std::size_t size{0};  ///< with the end of its last line [bytes]
};

std::optional<NumberType> type_of(std::string_view word) {
  constexpr std::pair<std::string_view, NumberType> types[] = {
      {"char", NumberType::int8},      {"int8", NumberType::int8},
      {"uchar", NumberType::uint8},    {"uint8", NumberType::uint8},
      {"short", NumberType::int16},    {"int16", NumberType::int16},
      {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},
      {"int", NumberType::int32},      {"int32", NumberType::int32},
      {"uint", NumberType::uint32},    {"uint32", NumberType::uint32},
      {"float", NumberType::float32},  {"float32", NumberType::float32},
      {"double", NumberType::float64}, {"float64", NumberType::float64}};
  for (const auto& [name, type] : types)
    if (word == name) return type;
  return {};
}

Property read_property(Words& words) {
  std::string_view word = words.in_line();
  std::optional<NumberType> length;
  if (word == "list") {
    length = type_of(words.in_line());
    if (!length || !is_whole(*length)) fail("has a list whose length is of no whole type");
    word = words.in_line();
  }
  const auto type = type_of(word);
  if (!type) fail("has a property of no known type");
  const std::string_view name = words.in_line();
  if (name.empty()) fail("has a property without a name");
  return {std::string(name), *type, length};
}

Header read_header(std::string_view bytes) {
  // Lines end as the first one does: else the first byte of binary data could be taken for an end.
  const std::string_view end = bytes.starts_with("ply\r\n") ? "\r\n"
                               : bytes.starts_with("ply\r") ? "\r"
                               : bytes.starts_with("ply\n") ? "\n"
                                                            : "";
  if (end.empty()) fail("does not begin with ply");
  Header header;
  bool has_format = false;
  std::size_t at = 0;
  for (;;) {
    const std::size_t next = bytes.find(end, at);
    if (next == std::string_view::npos) fail("has no end_header");
    Words line(bytes.substr(at, next - at));
    const std::string_view word = line.in_line();
    const bool first = at == 0;
    at = next + end.size();
    if (word == "end_header") break;
    if (first || word.empty() || word == "comment" || word == "obj_info") continue;
    if (word == "format") {
      const std::string_view format = line.in_line();
      if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
        fail("is of no known format: ascii, binary_little_endian or binary_big_endian");
      header.format = format == "ascii"                  ? Format::text
                      : format == "binary_little_endian" ? Format::little
                                                         : Format::big;
      has_format = true;
    } else if (word == "element") {
      const std::string_view name = line.in_line();
      const auto count = whole_of(line.in_line());
      if (name.empty() || !count || *count < 0) fail("has an element without a number");
      header.elements.push_back({std::string(name), static_cast<unsigned long long>(*count)});
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(line));
    } else {
      fail("has a line in its header that is none of a PLY");
    }
  }
  if (!has_format) fail("has no format");
  header.size = at;
  return header;
}

/// One number after the other, as text or as bytes.
class Data {
 public:
  Data(std::string_view data, Format format) : data_(data), words_(data), format_(format) {}

  double number(NumberType type) {
    if (format_ == Format::text) {
      const std::string_view word = words_.anywhere();
      if (word.empty()) end();
      const auto value = number_of(word);
      if (!value) fail("has something else than a number among its data");
      return *value;
    }
    const std::size_t size = size_of(type);
    if (data_.size() < size) end();
    const double value = number_at(data_.data(), type,
                                   format_ == Format::big ? std::endian::big : std::endian::little);
    data_.remove_prefix(size);
    return value;
  }
  long long whole(NumberType type) {
    const double value = number(type);
    const auto whole = value >= -9e15 && value <= 9e15 ? static_cast<long long>(value) : 0;
    if (static_cast<double>(whole) != value) fail("has a length or an index that is not whole");
    return whole;
  }
  /// What is not needed, whatever it is.
  void skip(NumberType type) {
    if (format_ != Format::text)
      number(type);
    else if (words_.anywhere().empty())
      end();
  }

 private:
  [[noreturn]] static void end() { fail("ends before its last element"); }

  std::string_view data_;
  Words words_;
  Format format_;
};

long long length_of(const Property& list, Data& data) {
  const long long length = data.whole(*list.length);
  if (length < 0) fail("has a list of fewer than no values");
  return length;
}

void skip(const Property& property, Data& data) {
  const long long count = property.length ? length_of(property, data) : 1;
  for (long long k = 0; k < count; ++k) data.skip(property.type);
}

void read_vertices(const Element& element, Data& data, Polygons& polygons) {
  std::vector<int> axes;  // of each property; -1 for none
  std::array<int, 3> found{};
  for (const Property& property : element.properties) {
    const auto axis = std::string("xyz").find(property.name);
    const bool one = !property.length && property.name.size() == 1 && axis != std::string::npos;
    axes.push_back(one ? static_cast<int>(axis) : -1);
    if (one) ++found[axis];
  }
  if (found != std::array{1, 1, 1}) fail("has vertices without x, y and z");
  for (unsigned long long i = 0; i < element.count; ++i) {
    Eigen::Vector3d vertex;
    for (std::size_t k = 0; k < axes.size(); ++k)
      if (axes[k] >= 0)
        vertex[axes[k]] = data.number(element.properties[k].type);
      else
        skip(element.properties[k], data);
    polygons.add_vertex(vertex);
  }
}

void read_faces(const Element& element, bool strips, Data& data, Polygons& polygons) {
  const auto is_indices = [](const Property& property) {
    return property.length && is_whole(property.type) &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  };
  int found = 0;
  for (const Property& property : element.properties) found += is_indices(property) ? 1 : 0;
  if (found != 1) fail("has faces without a list vertex_indices of whole numbers");
  for (unsigned long long i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      if (!is_indices(property)) {
        skip(property, data);
        continue;
      }
      const long long count = length_of(property, data);
      for (long long k = 0; k < count; ++k) {
        const long long vertex = data.whole(property.type);
        if (strips && vertex == -1)
          polygons.end_strip();  // another one begins
        else
          polygons.add_corner(vertex);
      }
      if (strips)
        polygons.end_strip();
      else
        polygons.end_face();
    }
}

}  // namespace

Mesh read_ply(std::string_view bytes) {
  const Header header = read_header(bytes);
  Data data(bytes.substr(header.size), header.format);
  Polygons polygons;
  for (const Element& element : header.elements) {
    if (element.name == "vertex" && polygons.vertices() > 0) fail("has its vertices twice");
    if (element.name == "vertex")
      read_vertices(element, data, polygons);
    else if (element.name == "face" || element.name == "tristrips")
      read_faces(element, element.name == "tristrips", data, polygons);
    else if (!element.properties.empty())
      for (unsigned long long i = 0; i < element.count; ++i)
        for (const Property& property : element.properties) skip(property, data);
  }
  return std::move(polygons).triangles();
}

}  // namespace poise
