#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "meshes/formats.hpp"
#include "meshes/numbers.hpp"
#include "meshes/words.hpp"
#include "shape/characters.hpp"

namespace poise {
namespace {

using Json = nlohmann::json;
using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr std::size_t most_json = std::size_t{1} << 27;     ///< [bytes]
constexpr std::size_t most_buffers = std::size_t{1} << 30;  ///< [bytes]
constexpr int most_depth = 64;
constexpr std::size_t most_primitives = 1'000'000;

[[noreturn]] void fail(const std::string& problem) {
  throw ReadError("cannot be read: " + problem);
}

struct Parts {
  std::string_view json, binary;
};

/// Of a binary file: a head of 12 bytes, then chunks, each with its length and type.
Parts parts_of(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  const auto word = [&](std::size_t at) {
    return static_cast<std::size_t>(number_at(bytes.data() + at, NumberType::uint32));
  };
  if (bytes.size() < 20) fail("is too short for a GLB");
  if (word(4) != 2) fail("is a GLB of version " + std::to_string(word(4)) + ", must be 2");
  if (word(8) != bytes.size())
    fail("says that it is " + std::to_string(word(8)) + " bytes long, but has " +
         std::to_string(bytes.size()));
  Parts parts;
  for (std::size_t at = 12; at < bytes.size();) {
    if (bytes.size() - at < 8 || word(at) > bytes.size() - at - 8)
      fail("has a chunk that is longer than the file");
    const std::string_view chunk = bytes.substr(at + 8, word(at)), type = bytes.substr(at + 4, 4);
    if (at == 12 && type != "JSON") fail("does not begin with a chunk of JSON");
    if (at == 12) parts.json = chunk;
    if (type == std::string_view("BIN\0", 4) && parts.binary.empty()) parts.binary = chunk;
    at += 8 + chunk.size();
  }
  return parts;
}

void check_depth(std::string_view json) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < json.size(); ++at) {
    const char c = json[at];
    if (c == '"') quoted = !quoted;
    if (quoted && c == '\\') ++at;
    if (quoted) continue;
    if ((c == '[' || c == '{') && ++depth > most_depth) fail("its JSON is nested too deeply");
    if (c == ']' || c == '}') --depth;
  }
}

Json parsed(std::string_view text) {
  if (text.size() > most_json) fail("has more than 128 MiB of JSON");
  check_depth(text);
  try {
    Json json = Json::parse(text);
    if (!json.is_object()) fail("is no glTF: its JSON is not an object");
    return json;
  } catch (const Json::exception&) {
    fail("is no glTF: its JSON is damaged");
  }
}

// What a member of an object is, if it is there.

const Json* find(const Json& object, const char* key) {
  if (!object.is_object()) fail(std::string("has something else than an object with ") + key);
  const auto member = object.find(key);
  return member == object.end() ? nullptr : &*member;
}

/// Its items; none where it is not there.
const Json& list(const Json& object, const char* key) {
  static const Json none = Json::array();
  const Json* const member = find(object, key);
  if (!member) return none;
  if (!member->is_array()) fail(std::string("has something else than a list for ") + key);
  return *member;
}

std::optional<std::size_t> whole(const Json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > (std::uint64_t{1} << 40))
    return {};
  return value.get<std::size_t>();
}

std::size_t whole(const Json& object, const char* key, std::optional<std::size_t> otherwise = {}) {
  const Json* const member = find(object, key);
  if (!member && otherwise) return *otherwise;
  const auto value = member ? whole(*member) : std::nullopt;
  if (!value) fail(std::string("has no whole number for ") + key);
  return *value;
}

/// What a number in an object stands for.
const Json& item(const Json& items, const std::optional<std::size_t>& index, const char* what) {
  if (!index || *index >= items.size()) fail(std::string("names a ") + what + " that is not there");
  return items[*index];
}

template <int Size>
std::optional<Eigen::Matrix<double, Size, 1>> numbers(const Json& object, const char* key) {
  const Json& values = list(object, key);
  if (!object.contains(key)) return {};
  Eigen::Matrix<double, Size, 1> result;
  bool right = values.size() == Size;
  for (std::size_t k = 0; right && k < Size; ++k) {
    right = values[k].is_number();
    if (right) result[static_cast<Eigen::Index>(k)] = values[k].get<double>();
  }
  if (!right)
    fail(std::string("has something else than ") + std::to_string(Size) + " numbers for " + key);
  return result;
}

Matrix4d place_of(const Json& node) {
  if (const auto entries = numbers<16>(node, "matrix"))
    return Eigen::Map<const Matrix4d>(entries->data());
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  if (const auto step = numbers<3>(node, "translation")) place.translate(*step);
  if (const auto turn = numbers<4>(node, "rotation")) {
    const Eigen::Quaterniond rotation(*turn);  // x, y, z, w
    if (!(rotation.norm() > 0)) fail("has a rotation without length");
    place.rotate(rotation.normalized());
  }
  if (const auto scale = numbers<3>(node, "scale")) place.scale(*scale);
  return place.matrix();
}

/// The bytes that text of four letters for three of them stands for (RFC 4648).
std::string from_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  unsigned bits = 0;
  int count = 0;
  for (const char letter : text) {
    const auto value =
        std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
            .find(letter);
    if (value == std::string_view::npos) fail("has a data URI that is not base64");
    bits = (bits << 6 | static_cast<unsigned>(value)) & 0xFFFFFF;
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xFF);
  }
  return bytes;
}

/// The path that a URI is: %20 stands for a space (RFC 3986).
std::string path_of(std::string_view uri) {
  std::string path;
  for (std::size_t at = 0; at < uri.size(); ++at) {
    if (uri[at] != '%') {
      path += uri[at];
      continue;
    }
    unsigned byte = 0;
    const char* const digits = uri.data() + at + 1;
    if (uri.size() - at < 3 || std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2 ||
        byte == 0)
      fail("has a URI with a % that is followed by no two digits");
    path += static_cast<char>(byte);
    at += 2;
  }
  return path;
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::function<std::string(const std::string&)>& named)
      : parts_(parts_of(bytes)), json_(parsed(parts_.json)), named_(named) {}

  Mesh read() {
    const Json* const asset = find(json_, "asset");
    const Json* const version = asset ? find(*asset, "version") : nullptr;
    if (!version || !version->is_string() ||
        !version->get_ref<const std::string&>().starts_with("2."))
      fail("is not of version 2 of glTF");
    check_extensions();
    const Json& scenes = list(json_, "scenes");
    if (scenes.empty()) fail("has no scene");
    read_tree(list(item(scenes, whole(json_, "scene", 0), "scene"), "nodes"));
    return std::move(mesh_);
  }

 private:
  /// Of what a reader must know, what changes no vertex can be ignored.
  void check_extensions() const {
    for (const Json& extension : list(json_, "extensionsRequired")) {
      const std::string name = extension.is_string() ? extension.get<std::string>() : "";
      const auto begins = [&](const char* with) { return name.starts_with(with); };
      if (name != "KHR_mesh_quantization" && !begins("KHR_materials_") && !begins("KHR_texture_") &&
          !begins("EXT_texture_") && !begins("KHR_lights_"))
        throw ReadError("needs the extension " + shown(name) + ", which is not read");
    }
  }

  /// Each node once: it has at most one parent (glTF 2.0, 3.5.2).
  void read_tree(const Json& roots) {
    const Json& nodes = list(json_, "nodes");
    struct Place {
      std::size_t node;
      Matrix4d above;
    };
    std::vector<Place> stack;
    std::vector<bool> seen(nodes.size(), false);
    const auto push = [&](const Json& children, const Matrix4d& above) {
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        const auto index = whole(*child);
        item(nodes, index, "node");
        if (seen[*index]) fail("has a node with more than one parent");
        seen[*index] = true;
        stack.push_back({*index, above});
      }
    };
    push(roots, Matrix4d::Identity());
    while (!stack.empty()) {
      const auto [index, above] = stack.back();
      stack.pop_back();
      const Json& node = nodes[index];
      const Matrix4d place = above * place_of(node);
      if (const Json* const extensions = find(node, "extensions"))
        if (find(*extensions, "EXT_mesh_gpu_instancing"))
          throw ReadError("has instances (EXT_mesh_gpu_instancing), which are not read");
      if (node.contains("mesh")) {
        if (node.contains("skin"))
          throw ReadError("has a skin, which is not read: export the mesh as it is");
        read_mesh(node, item(list(json_, "meshes"), whole(node, "mesh"), "mesh"), place);
      }
      push(list(node, "children"), place);
    }
  }

  void read_mesh(const Json& node, const Json& mesh, const Matrix4d& place) {
    first_.clear();
    const bool morphed = [&] {
      for (const Json& weight : list(node.contains("weights") ? node : mesh, "weights"))
        if (!weight.is_number() || weight.get<double>() != 0) return true;
      return false;
    }();
    for (const Json& primitive : list(mesh, "primitives")) {
      if (++primitives_ > most_primitives) fail("has more than 1000000 primitives");
      if (morphed && !list(primitive, "targets").empty())
        throw ReadError("has morph targets, which are not read: export the mesh as it is");
      read_primitive(primitive, place);
    }
  }

  void read_primitive(const Json& primitive, const Matrix4d& place) {
    const std::size_t mode = whole(primitive, "mode", 4);
    if (mode < 4) return;  // points and lines bound nothing
    if (mode > 6) fail("has a primitive of no known mode");
    const Json* const attributes = find(primitive, "attributes");
    const Json* const position = attributes ? find(*attributes, "POSITION") : nullptr;
    if (!position) fail("has a primitive without POSITION");
    const auto accessor = whole(*position);
    const Accessor positions = open(accessor, "VEC3", 3);
    const auto found = first_.find(*accessor);
    const std::size_t first = found == first_.end() ? mesh_.vertices.size() : found->second;
    if (found == first_.end()) {
      first_[*accessor] = first;
      if (positions.count > most_triangles - first) refuse_size();
      for (std::size_t i = 0; i < positions.count; ++i) {
        const Vector3d own(positions.value(i, 0), positions.value(i, 1), positions.value(i, 2));
        mesh_.vertices.emplace_back((place * own.homogeneous()).head<3>());
      }
    }
    std::optional<Accessor> indices;
    if (const Json* const index = find(primitive, "indices")) {
      indices = open(whole(*index), "SCALAR", 1);
      if (indices->normalized ||
          (indices->type != NumberType::uint8 && indices->type != NumberType::uint16 &&
           indices->type != NumberType::uint32))
        fail("has indices of a type that is none for them");
    }
    const auto corner = [&](std::size_t k) {
      const auto vertex = indices ? static_cast<std::size_t>(indices->value(k, 0)) : k;
      if (vertex >= positions.count) fail("has a primitive that names a vertex that is not there");
      return static_cast<int>(first + vertex);
    };
    const std::size_t count = indices ? indices->count : positions.count;
    const std::size_t triangles = mode == 4 ? count / 3 : count < 3 ? 0 : count - 2;
    if (triangles > most_triangles - mesh_.triangles.size()) refuse_size();
    const bool mirrored = place.topLeftCorner<3, 3>().determinant() < 0;
    for (std::size_t t = 0; t < triangles; ++t) {
      std::array<int, 3> triangle =
          mode == 4   ? std::array{corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)}
          : mode == 5 ? std::array{corner(t), corner(t + 1 + t % 2), corner(t + 2 - t % 2)}
                      : std::array{corner(0), corner(t + 1), corner(t + 2)};
      if (mirrored) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
    }
  }

  [[noreturn]] static void refuse_size() {
    throw ReadError("has more than " + std::to_string(most_triangles) +
                    " triangles or vertices, the most that is read");
  }

  /// Numbers in a buffer, all of which are there.
  struct Accessor {
    const char* begin;
    std::size_t count, stride;
    NumberType type;
    bool normalized;

    double value(std::size_t at, std::size_t component) const {
      const double number = number_at(begin + at * stride + component * size_of(type), type);
      if (!normalized) return number;
      switch (type) {
        case NumberType::int8:
          return std::max(number / 127, -1.0);
        case NumberType::uint8:
          return number / 255;
        case NumberType::int16:
          return std::max(number / 32767, -1.0);
        default:
          return number / 65535;
      }
    }
  };

  Accessor open(const std::optional<std::size_t>& index, const char* type, std::size_t components) {
    const Json& accessor = item(list(json_, "accessors"), index, "accessor");
    if (accessor.is_object() && accessor.contains("sparse"))
      throw ReadError("has sparse accessors, which are not read");
    const Json* const given = find(accessor, "type");
    if (!given || *given != type)
      fail(std::string("has an accessor that is no ") + type + " where one is needed");
    Accessor result{};
    const std::map<std::size_t, NumberType> types = {
        {5120, NumberType::int8},   {5121, NumberType::uint8},  {5122, NumberType::int16},
        {5123, NumberType::uint16}, {5125, NumberType::uint32}, {5126, NumberType::float32}};
    const auto number = types.find(whole(accessor, "componentType"));
    if (number == types.end()) fail("has an accessor of no known componentType");
    result.type = number->second;
    if (const Json* const normalized = find(accessor, "normalized"))
      result.normalized = *normalized == true;
    if (result.normalized && size_of(result.type) > 2)
      fail("has an accessor of 32 bits that is normalized");
    result.count = whole(accessor, "count");
    const Json& view =
        item(list(json_, "bufferViews"), whole(accessor, "bufferView"), "bufferView");
    const std::string_view buffer = bytes_of(whole(view, "buffer"));
    const std::size_t from = whole(view, "byteOffset", 0), length = whole(view, "byteLength"),
                      within = whole(accessor, "byteOffset", 0),
                      size = components * size_of(result.type);
    result.stride = whole(view, "byteStride", size);
    if (from > buffer.size() || length > buffer.size() - from)
      fail("has a bufferView that is longer than its buffer");
    if (result.stride < size || result.stride > 252) fail("has a byteStride that is none");
    if (result.count > 0 && (within > length || length - within < size ||
                             (length - within - size) / result.stride < result.count - 1))
      fail("has an accessor that is longer than its bufferView");
    result.begin = buffer.data() + from + (result.count > 0 ? within : 0);
    return result;
  }

  /// A buffer, of the file, in a URI, or in a file of its own.
  std::string_view bytes_of(std::size_t index) {
    const Json& buffer = item(list(json_, "buffers"), index, "buffer");
    const std::size_t length = whole(buffer, "byteLength");
    const Json* const given = find(buffer, "uri");
    std::string_view bytes = index == 0 && !given ? parts_.binary : std::string_view();
    if (given) {
      if (!given->is_string()) fail("has a URI that is none");
      const std::string_view uri = given->get_ref<const std::string&>();
      const std::size_t comma = uri.find(',');
      const bool data = same_word(uri.substr(0, 5), "data:");
      if (data && (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")))
        fail("has a data URI that is not base64");
      const std::string path = data ? "" : path_of(uri);
      const auto [loaded, is_new] =
          buffers_.try_emplace({data, data ? std::to_string(index) : path});
      if (is_new) {
        loaded->second = data ? from_base64(uri.substr(comma + 1)) : named_(path);
        if ((loaded_ += loaded->second.size()) > most_buffers)
          fail("has buffers of more than 1 GiB");
      }
      bytes = loaded->second;
    }
    if (length > bytes.size())
      fail("has a buffer of " + std::to_string(length) + " bytes, of which " +
           std::to_string(bytes.size()) + " are there");
    return bytes.substr(0, length);
  }

  Parts parts_;
  Json json_;
  const std::function<std::string(const std::string&)>& named_;
  std::map<std::pair<bool, std::string>, std::string> buffers_{};  ///< data URI or path: bytes
  std::size_t loaded_{0};                                          ///< all of them [bytes]
  std::map<std::size_t, std::size_t> first_{};  ///< vertex of an accessor, within a node
  std::size_t primitives_{0};
  Mesh mesh_{};
};

}  // namespace

Mesh read_gltf(std::string_view bytes,
               const std::function<std::string(const std::string&)>& named) {
  return Reader(bytes, named).read();
}

}  // namespace poise
