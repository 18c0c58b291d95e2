// Files of meshes: what others write is read as they mean it, what is damaged or hostile is
// refused, and says so.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "files/grasp_file.hpp"
#include "meshes.hpp"
#include "meshes/formats.hpp"

namespace poise {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

/// 60 mm, about the origin.
const Mesh cube =
    moved(box_mesh({0.06, 0.06, 0.06}), Eigen::Affine3d(Eigen::Translation3d(-0.03, -0.03, -0.03)));
const std::vector<std::vector<int>> quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
const double volume_of_cube = 0.06 * 0.06 * 0.06;

template <class Number>
void put(std::string& bytes, Number number, std::endian order = std::endian::little) {
  std::string own(reinterpret_cast<const char*>(&number), sizeof number);
  if (order != std::endian::native) std::reverse(own.begin(), own.end());
  bytes += own;
}

std::string problem(const std::function<void()>& read) {
  try {
    read();
  } catch (const ReadError& error) {
    return error.what();
  }
  return "";
}

/// A closed surface of this volume, whose triangles face outwards.
void expect_body(const Mesh& mesh, double expected, double tolerance = 1e-7) {
  const MendedMesh closed = mended(mesh);
  EXPECT_EQ(closed.defect, "");
  EXPECT_EQ(closed.repairs, std::vector<std::string>());
  EXPECT_NEAR(volume(closed.mesh) / expected, 1, tolerance);
}

// STL

std::string text_stl(const Mesh& mesh, const std::string& normal = "0 0 0") {
  std::ostringstream out;
  out.precision(15);
  out << "solid part\n";
  for (const auto& triangle : mesh.triangles) {
    out << "facet normal " << normal << "\nouter loop\n";
    for (const int i : triangle)
      out << "vertex " << mesh.vertices[static_cast<std::size_t>(i)].transpose() << '\n';
    out << "endloop\nendfacet\n";
  }
  return out.str() + "endsolid part\n";
}

std::string binary_stl(const Mesh& mesh, std::string head = "solid") {
  head.resize(80, ' ');
  put(head, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    head.append(12, '\0');
    for (const int i : triangle)
      for (const double x : mesh.vertices[static_cast<std::size_t>(i)])
        put(head, static_cast<float>(x));
    head.append(2, '\0');
  }
  return head;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

TEST(Stl, IsReadAsOthersWriteIt) {
  const std::string text = text_stl(cube);
  std::string capital = text;
  for (char& c : capital) c = static_cast<char>(std::toupper(c));
  for (const std::string& bytes :
       {text, capital, "\n" + text, "  \r\n\t" + text, replaced(text, "\n", "\r\n"),
        replaced(text, "\n", "\r"), text_stl(cube, "-1.#IND -1.#IND -1.#IND"),
        text_stl(cube, "nan nan nan"), replaced(text, "endloop\nendfacet\n", "endloop endfacet "),
        replaced(text, " 0.03", " +3.0E-02"), replaced(text, "endsolid part", "")})
    expect_body(read_stl(bytes), volume_of_cube);
  // Text keeps all digits; beyond single precision too.
  const Mesh far = moved(cube, Eigen::Affine3d(Eigen::Translation3d(1e9, 0, 0)));
  EXPECT_EQ(bounds(read_stl(text_stl(far))).min(), bounds(far).min());
  // Two solids in a file.
  const Mesh other = moved(cube, Eigen::Affine3d(Eigen::Translation3d(1, 0, 0)));
  EXPECT_EQ(read_stl(text + text_stl(other)).triangles.size(), 24U);
}

TEST(Stl, OfBytesIsToldByItsLength) {
  const std::string bytes = binary_stl(cube);
  expect_body(read_stl(bytes), volume_of_cube, 1e-6);
  expect_body(read_stl(binary_stl(cube, "made by hand")), volume_of_cube, 1e-6);
  expect_body(read_stl(binary_stl(cube, "a") + std::string(2, '\0')), volume_of_cube, 1e-6);
  EXPECT_EQ(problem([&] { read_stl(bytes.substr(0, bytes.size() - 1)); }),
            "cannot be read: says that it has 12 triangles, but is as long as 11");
  std::string false_count = bytes;
  false_count.replace(80, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_EQ(problem([&] { read_stl(false_count); }),
            "cannot be read: says that it has 4294967295 triangles, but is as long as 12");
}

TEST(Stl, SaysWhichLineIsWrong) {
  EXPECT_EQ(problem([] { read_stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"); }),
            "cannot be read: line 5 is no part of an STL: vertex expected");
  EXPECT_EQ(problem([] { read_stl("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0,5 0\n"); }),
            "cannot be read: line 4 has a vertex that is not three numbers");
  EXPECT_EQ(problem([] { read_stl("a mesh\n"); }),
            "cannot be read: is no STL, neither text nor long enough for a binary one");
  EXPECT_EQ(problem([] { read_stl(""); }),
            "cannot be read: is no STL, neither text nor long enough for a binary one");
}

// PLY

const std::string vertex_head =
    "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n";
const std::string face_head = "element face 6\nproperty list uchar int vertex_indices\n";

std::string binary_ply(std::endian order, const std::string& end, unsigned char first_byte) {
  const bool little = order == std::endian::little;
  std::string bytes = replaced("ply\nformat binary_" + std::string(little ? "little" : "big") +
                                   "_endian 1.0\n" + vertex_head + face_head + "end_header\n",
                               "\n", end);
  const std::size_t begin = bytes.size();
  for (const Vector3d& v : cube.vertices)
    for (const double x : v) put(bytes, static_cast<float>(x), order);
  bytes[begin + (little ? 0 : 3)] = static_cast<char>(first_byte);  // the last digits of -0.03
  for (const auto& quad : quads) {
    bytes += '\4';
    for (const int i : quad) put(bytes, std::int32_t{i}, order);
  }
  return bytes;
}

TEST(Ply, OfBytesBeginsRightAfterItsHeader) {
  // Each value of the first byte, line ends among them, whatever ends the lines of the header.
  for (const std::string end : {"\n", "\r\n", "\r"})
    for (int byte = 0; byte < 256; ++byte)
      for (const std::endian order : {std::endian::little, std::endian::big})
        expect_body(read_ply(binary_ply(order, end, static_cast<unsigned char>(byte))),
                    volume_of_cube, 1e-5);
}

std::string text_ply(const std::string& head, const std::string& data) {
  return "ply\nformat ascii 1.0\ncomment by hand\n" + head + "end_header\n" + data;
}

std::string vertex_lines() {
  std::ostringstream out;
  out.precision(15);
  for (const Vector3d& v : cube.vertices) out << v.transpose() << '\n';
  return out.str();
}
std::string face_lines() {
  std::ostringstream out;
  for (const auto& q : quads)
    out << "4 " << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
  return out.str();
}

TEST(Ply, IsReadInAnyOrderAndWithOtherProperties) {
  expect_body(read_ply(text_ply(vertex_head + face_head, vertex_lines() + face_lines())),
              volume_of_cube);
  expect_body(read_ply(text_ply(face_head + vertex_head, face_lines() + vertex_lines())),
              volume_of_cube);
  expect_body(read_ply(replaced(text_ply(vertex_head + face_head, vertex_lines() + face_lines()),
                                "\n", "\r\n")),
              volume_of_cube);
  // Normals that are none, lists at vertices, an element that is not known.
  const std::string head =
      "element vertex 8\nproperty double z\nproperty float nx\nproperty list "
      "uchar float weights\nproperty double x\nproperty double y\n"
      "element camera 2\nproperty list int int ids\nproperty float f\n"
      "element empty 1000000000000\n" +
      replaced(face_head, "vertex_indices", "vertex_index");
  std::ostringstream data;
  data.precision(15);
  for (const Vector3d& v : cube.vertices)
    data << v.z() << " -1.#IND 2 0.5 nan " << v.x() << ' ' << v.y() << '\n';
  const Mesh mesh = read_ply(text_ply(head, data.str() + "3 1 2 3 0.5\n0 2\n" + face_lines()));
  expect_body(mesh, volume_of_cube);
  EXPECT_EQ(mesh.vertices, cube.vertices);
}

TEST(Ply, StripsAreTriangles) {
  const std::string head =
      vertex_head + "element tristrips 1\nproperty list int int vertex_indices\n";
  // Round the cube; x varies fastest in box_mesh.
  const std::vector<int> by_z = {3, 7, 2, 6, 4, 7, 5, 3, 1, 2, 0, 4, 1, 5};
  const auto in_x = [](int v) { return (v & 1) << 2 | (v & 2) | (v & 4) >> 2; };
  std::string strip = "14";
  for (const int v : by_z) strip += " " + std::to_string(in_x(v));
  const MendedMesh closed = mended(read_ply(text_ply(head, vertex_lines() + strip)));
  EXPECT_EQ(closed.defect, "");
  EXPECT_EQ(closed.mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume(closed.mesh), volume_of_cube, 1e-10);
  // All agree: either none was turned, or all of them.
  EXPECT_LE(closed.repairs.size(), 1U);
  // -1 begins another one.
  const Mesh two = read_ply(text_ply(head, vertex_lines() + "9 0 1 2 3 -1 4 5 6 7"));
  ASSERT_EQ(two.triangles.size(), 4U);
  EXPECT_EQ(two.triangles[1], (std::array{2, 1, 3}));
  EXPECT_EQ(two.triangles[2], (std::array{4, 5, 6}));
}

TEST(Ply, SaysWhatIsWrong) {
  const std::string good = vertex_head + face_head, data = vertex_lines() + face_lines();
  const auto why = [](const std::string& bytes) { return problem([&] { read_ply(bytes); }); };
  EXPECT_EQ(why("plymouth\n"), "cannot be read: does not begin with ply");
  EXPECT_EQ(why("ply\nformat ascii 1.0\n"), "cannot be read: has no end_header");
  EXPECT_EQ(why("ply\n" + good + "end_header\n"), "cannot be read: has no format");
  EXPECT_EQ(why(replaced(text_ply(good, data), "ascii", "zip")),
            "cannot be read: is of no known format: ascii, binary_little_endian or "
            "binary_big_endian");
  EXPECT_EQ(why(replaced(text_ply(good, data), "vertex 8", "vertex 800000000000000")),
            "cannot be read: ends before its last element");
  EXPECT_EQ(why(replaced(text_ply(good, data), "0.03 ", "0,03 ")),
            "cannot be read: has something else than a number among its data");
  EXPECT_EQ(why(text_ply(good, vertex_lines())), "cannot be read: ends before its last element");
  EXPECT_EQ(why(text_ply(good, vertex_lines() + replaced(face_lines(), "7", "8"))),
            "has a face that names a vertex that is not there");
  EXPECT_EQ(why(text_ply(good, vertex_lines() + replaced(face_lines(), "7", "-1"))),
            "has a face that names a vertex that is not there");
  EXPECT_EQ(why(replaced(text_ply(good, data), "float y", "float x")),
            "cannot be read: has vertices without x, y and z");
  EXPECT_EQ(why(replaced(text_ply(good, data), "uchar int", "float int")),
            "cannot be read: has a list whose length is of no whole type");
  EXPECT_EQ(why(replaced(text_ply(good, data), "uchar int", "uchar float")),
            "cannot be read: has faces without a list vertex_indices of whole numbers");
  EXPECT_EQ(why(text_ply(good + vertex_head, data + vertex_lines())),
            "cannot be read: has its vertices twice");
}

// OBJ

std::string obj(const std::string& corner) {
  std::ostringstream out;
  out.precision(15);
  for (const Vector3d& v : cube.vertices) out << "v " << v.transpose() << '\n';
  for (const auto& quad : quads) {
    out << "f";
    for (const int i : quad)
      out << ' '
          << replaced(replaced(corner, "%", std::to_string(i + 1)), "~", std::to_string(i - 8));
    out << '\n';
  }
  return out.str();
}

TEST(Obj, CornersMayNameWhatIsNotThere) {
  for (const char* corner : {"%", "%/%", "%/%/%", "%//%", "%/", "~", "~/~/~", "%/99/77"})
    expect_body(read_obj(obj(corner)), volume_of_cube);
}

TEST(Obj, IsReadAsOthersWriteIt) {
  const std::string text = obj("%");
  const std::string face_first = text.substr(text.find('f')) + text.substr(0, text.find('f'));
  for (const std::string& bytes :
       {text, replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"), "\xEF\xBB\xBF" + text,
        face_first, "# by hand\nmtllib ../none.mtl\nvn a b c\no cube\ng all\nusemtl red\n" + text,
        replaced(text, "f 1 3", "f \\\n 1 \\\r\n 3"), text + "l 1 2\np 3\nf 1 2\nf\n",
        replaced(text, "\nv", " 0.5 0.5 0.5\nv"), replaced(text, "\nf", " # a face\nf")})
    expect_body(read_obj(bytes), volume_of_cube);
}

TEST(Obj, SaysWhatIsWrong) {
  const auto why = [](const std::string& bytes) { return problem([&] { read_obj(bytes); }); };
  EXPECT_EQ(why("v 0 0\n"), "cannot be read: line 1 has a vertex that is not three numbers");
  EXPECT_EQ(why("v 0 0 0\nf 1 a 1\n"),
            "cannot be read: line 2 has a face whose corners are no vertices");
  EXPECT_EQ(why("v 0 0 0\nf 0 1 1\n"),
            "cannot be read: line 2 has a face whose corners are no vertices");
  EXPECT_EQ(why("v 0 0 0\nf 1 1 -2\n"),
            "cannot be read: line 2 has a face that names a vertex that is not there");
  EXPECT_EQ(why("v 0 0 0\nf 1 1 2\n"), "has a face that names a vertex that is not there");
  EXPECT_EQ(why("f 1 2 99999999999999999999\n"),
            "cannot be read: line 1 has a face whose corners are no vertices");
  EXPECT_EQ(why("cstype bezier\nsurf 0 1 0 1 1 2 3\n"),
            "cannot be read: line 2 has a free-form curve or surface (surf), which is not read: "
            "export triangles");
  EXPECT_EQ(why("call other.obj\n"),
            "cannot be read: line 1 runs another file (call), which is not done");
}

// Polygons

Mesh of_polygon(const std::vector<Vector3d>& corners) {
  std::ostringstream out;
  out.precision(15);
  for (const Vector3d& v : corners) out << "v " << v.transpose() << '\n';
  out << "f";
  for (std::size_t i = 1; i <= corners.size(); ++i) out << ' ' << i;
  return read_obj(out.str() + "\n");
}

/// Triangles that cover a polygon once: their areas add up, and none faces the other way.
void expect_cover(const std::vector<Vector3d>& corners) {
  Vector3d whole = Vector3d::Zero(), sum = Vector3d::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k)
    whole += corners[k].cross(corners[(k + 1) % corners.size()]) / 2;
  const Mesh mesh = of_polygon(corners);
  EXPECT_EQ(mesh.triangles.size(), corners.size() - 2);
  double area = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d &a = mesh.vertices[static_cast<std::size_t>(i)],
                   &b = mesh.vertices[static_cast<std::size_t>(j)],
                   &c = mesh.vertices[static_cast<std::size_t>(k)];
    const Vector3d own = (b - a).cross(c - a) / 2;
    sum += own;
    area += own.norm();
    EXPECT_GE(own.dot(whole), -1e-12 * whole.squaredNorm());
  }
  EXPECT_LE((sum - whole).norm(), 1e-9 * whole.norm());
  EXPECT_NEAR(area / whole.norm(), 1, 1e-9);
}

TEST(Polygons, AreCoveredOnce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.1, 1);
  std::normal_distribution<double> turn;
  for (int round = 0; round < 300; ++round) {
    const Eigen::Matrix3d frame =
        Eigen::Quaterniond(turn(random), turn(random), turn(random), turn(random))
            .normalized()
            .toRotationMatrix();
    std::vector<Vector3d> star;
    const int count = 4 + static_cast<int>(random() % 60);
    for (int k = 0; k < count; ++k) {
      const double angle = test::turn(k, count), r = number(random);
      star.push_back(frame * Vector3d(r * std::cos(angle), r * std::sin(angle), 0) +
                     Vector3d(1, 2, 3));
    }
    if (round % 2 == 0) std::reverse(star.begin(), star.end());
    expect_cover(star);
  }
  // A comb, with corners in a line; a frame cut open, whose cut is gone along twice.
  std::vector<Vector3d> comb{{0, 0, 0}, {40, 0, 0}, {40, 1, 0}};
  for (int k = 39; k >= 1; --k) comb.emplace_back(k, k % 2 == 0 ? 1 : 30, 0);
  comb.emplace_back(0, 1, 0);
  expect_cover(comb);
  expect_cover({{0, 0, 0},
                {4, 0, 0},
                {4, 4, 0},
                {0, 4, 0},
                {0, 0, 0},
                {1, 1, 0},
                {1, 3, 0},
                {3, 3, 0},
                {3, 1, 0},
                {1, 1, 0}});
}

TEST(Polygons, OfManyCornersTakeNoTime) {
  std::vector<Vector3d> circle, gear;
  for (int k = 0; k < 200000; ++k)
    circle.emplace_back(std::cos(turn(k, 200000)), std::sin(turn(k, 200000)), 0);
  EXPECT_EQ(of_polygon(circle).triangles.size(), 199998U);
  for (int k = 0; k < 2000; ++k)
    gear.push_back((k % 2 == 0 ? 1 : 0.9) *
                   Vector3d(std::cos(turn(k, 2000)), std::sin(turn(k, 2000)), 0));
  expect_cover(gear);
  // Not within any patience: corners at random.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Vector3d> tangle;
  for (int k = 0; k < 20000; ++k) tangle.emplace_back(number(random), number(random), 0);
  const std::string why = problem([&] { of_polygon(tangle); });
  EXPECT_TRUE(why.empty() || why ==
                                 "has faces that are not convex with too many corners: cut "
                                 "them into triangles")
      << why;
}

// glTF

/// The cube's vertices as floats, then the indices of its triangles.
std::string cube_bytes() {
  std::string bytes;
  for (const Vector3d& v : cube.vertices)
    for (const double x : v) put(bytes, static_cast<float>(x));
  for (const auto& triangle : cube.triangles)
    for (const int i : triangle) put(bytes, static_cast<std::uint16_t>(i));
  return bytes;
}

Json gltf() {
  return Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 96},
                    {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
    "buffers": [{"byteLength": 168, "uri": "data:application/octet-stream;base64,)" +
                     base64(cube_bytes()) + R"("}]})");
}

std::string glb(Json json, std::string binary) {
  json["buffers"][0].erase("uri");
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(28 + text.size() + binary.size()));
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  put(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

Mesh read(const Json& json) {
  return read_gltf(json.dump(), [](const std::string& path) -> std::string {
    throw ReadError("names " + path);
  });
}
std::string why(const Json& json) {
  return problem([&] { read(json); });
}

TEST(Gltf, IsReadFromTextAndFromBytes) {
  expect_body(read(gltf()), volume_of_cube, 1e-6);
  expect_body(read_gltf(glb(gltf(), cube_bytes()), {}), volume_of_cube, 1e-6);
  Json soup = gltf();  // without indices, as a strip and as a fan
  for (const int mode : {4, 5, 6}) {
    soup["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}, {"mode", mode}};
    EXPECT_EQ(read(soup).triangles.size(), mode == 4 ? 2U : 6U);
  }
}

TEST(Gltf, NodesPlaceTheirMeshes) {
  Json json = gltf();
  json["nodes"] = Json::parse(R"([{"children": [1, 2], "translation": [0, 0, 1]},
    {"mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752],
     "translation": [1, 0, 0]},
    {"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]}])");
  const MendedMesh both = mended(read(json));
  EXPECT_EQ(both.defect, "");
  // The mirrored one is not inside out.
  EXPECT_EQ(both.repairs, std::vector<std::string>{
                              "has 2 parts that do not overlap: they are taken as one rigid body"});
  EXPECT_NEAR(volume(both.mesh) / volume_of_cube, 9, 1e-5);
  EXPECT_LE((centroid(both.mesh) - Vector3d((8 * 1 + 5) / 9.0, 0, 1)).norm(), 1e-7);
}

TEST(Gltf, SmallNumbersAreMeantAsTheyAreQuantized) {
  // KHR_mesh_quantization: 16 bits from -1 to 1, or as whole numbers.
  for (const bool normalized : {true, false}) {
    std::string bytes;
    for (const Vector3d& v : cube.vertices)
      for (const double x : v) put(bytes, static_cast<std::int16_t>(x > 0 ? 32767 : -32767));
    Json json = gltf();
    const std::string indices = cube_bytes().substr(96);
    json["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_materials_unlit"};
    json["accessors"][0].update({{"componentType", 5122}, {"normalized", normalized}});
    json["bufferViews"] = Json::parse(R"([{"buffer": 0, "byteLength": 48},
      {"buffer": 0, "byteOffset": 48, "byteLength": 72}])");
    json["buffers"][0] = {{"byteLength", 120}, {"uri", "data:;base64," + base64(bytes + indices)}};
    json["nodes"][0]["scale"] = std::vector<double>(3, normalized ? 0.03 : 0.03 / 32767);
    expect_body(read(json), volume_of_cube, 1e-9);
  }
}

TEST(Gltf, WhatIsNotReadIsNamed) {
  Json json = gltf();
  json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_EQ(why(json), "needs the extension KHR_draco_mesh_compression, which is not read");
  json = gltf();
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 0;
  EXPECT_EQ(why(json), "has instances (EXT_mesh_gpu_instancing), which are not read");
  json = gltf();
  json["nodes"][0]["skin"] = 0;
  EXPECT_EQ(why(json), "has a skin, which is not read: export the mesh as it is");
  json = gltf();
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  EXPECT_EQ(why(json), "");
  json["meshes"][0]["weights"] = {0.5};
  EXPECT_EQ(why(json), "has morph targets, which are not read: export the mesh as it is");
  json = gltf();
  json["accessors"][0]["sparse"]["count"] = 1;
  EXPECT_EQ(why(json), "has sparse accessors, which are not read");
}

TEST(Gltf, IsATree) {
  Json json = gltf();
  json["nodes"] = Json::array();
  for (int k = 0; k < 24; ++k) json["nodes"].push_back({{"children", {k + 1, k + 1}}});
  json["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(why(json), "cannot be read: has a node with more than one parent");
  json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
  EXPECT_EQ(why(json), "cannot be read: has a node with more than one parent");
  // A chain of 100,000 nodes is a tree.
  json["nodes"] = Json::array();
  for (int k = 0; k < 100000; ++k) json["nodes"].push_back({{"children", {k + 1}}});
  json["nodes"].push_back({{"mesh", 0}});
  expect_body(read(json), volume_of_cube, 1e-6);
}

TEST(Gltf, TrianglesAreCountedBeforeTheyAreMade) {
  Json json = gltf();
  const std::size_t count = most_triangles + 3;
  json["meshes"][0]["primitives"][0]["mode"] = 5;
  json["accessors"][1].update({{"componentType", 5121}, {"count", count}});
  json["bufferViews"][1]["byteLength"] = count;
  json["buffers"][0]["byteLength"] = 96 + count;
  const std::string bytes = glb(json, std::string(96 + count, '\0'));
  EXPECT_EQ(problem([&] { read_gltf(bytes, {}); }),
            "has more than 20000000 triangles or vertices, the most that is read");
}

TEST(Gltf, EveryLengthIsChecked) {
  const auto with = [](const std::string& where, const Json& value) {
    Json json = gltf();
    json[Json::json_pointer(where)] = value;
    return why(json);
  };
  EXPECT_EQ(with("/buffers/0/byteLength", 169),
            "cannot be read: has a buffer of 169 bytes, of which 168 are there");
  for (const Json& value : {Json(97), Json(1e9), Json(-1), Json("96")})
    EXPECT_NE(with("/bufferViews/1/byteOffset", value), "") << value;
  EXPECT_EQ(with("/bufferViews/1/byteLength", 73),
            "cannot be read: has a bufferView that is longer than its buffer");
  for (const Json& value : {Json(9), Json(1ULL << 39), Json(~0ULL)})
    EXPECT_NE(with("/accessors/0/count", value), "") << value;
  EXPECT_EQ(with("/accessors/0/byteOffset", 4),
            "cannot be read: has an accessor that is longer than its bufferView");
  EXPECT_EQ(with("/bufferViews/0/byteStride", 11), "cannot be read: has a byteStride that is none");
  EXPECT_EQ(with("/accessors/0/count", 7),
            "cannot be read: has a primitive that names a vertex that is not there");
  EXPECT_EQ(with("/accessors/1/componentType", 5126),
            "cannot be read: has an accessor that is longer than its bufferView");
  for (const char* where :
       {"/nodes/0/mesh", "/scenes/0/nodes/0", "/accessors/0/bufferView", "/bufferViews/0/buffer",
        "/scene", "/meshes/0/primitives/0/attributes/POSITION"})
    EXPECT_NE(with(where, 7).find(" that is not there"), std::string::npos) << where;
  EXPECT_EQ(why(Json::parse(R"({"asset": {"version": "1.0"}})")),
            "cannot be read: is not of version 2 of glTF");
}

TEST(Gltf, LengthsOfBytesAreThoseOfTheFile) {
  const std::string good = glb(gltf(), cube_bytes());
  const auto damaged = [&](std::size_t at, const std::string& with) {
    std::string bytes = good;
    bytes.replace(at, with.size(), with);
    return problem([&] { read_gltf(bytes, {}); });
  };
  EXPECT_EQ(damaged(8, "\xFF\xFF\xFF\xFF"),
            "cannot be read: says that it is 4294967295 bytes long, but has " +
                std::to_string(good.size()));
  EXPECT_EQ(damaged(12, "\xFF\xFF\xFF\xFF"),
            "cannot be read: has a chunk that is longer than the file");
  EXPECT_EQ(damaged(4, "\1"), "cannot be read: is a GLB of version 1, must be 2");
}

TEST(Gltf, BracketsOverflowNothing) {
  for (const std::string& bytes :
       {std::string(1000000, '['), std::string(70, '[') + std::string(70, ']')})
    EXPECT_EQ(problem([&] { read_gltf(bytes, {}); }),
              "cannot be read: its JSON is nested too deeply");
  EXPECT_EQ(problem([&] { read_gltf("{\"asset\": ", {}); }),
            "cannot be read: is no glTF: its JSON is damaged");
}

/// Damaged in all ways: read or refused, never more.
TEST(Formats, DamagedBytesAreReadOrRefused) {
  const auto as_gltf = [](std::string_view bytes) {
    return read_gltf(bytes, [](const std::string&) { return std::string(168, '\0'); });
  };
  const std::vector<std::pair<std::string, std::function<Mesh(std::string_view)>>> samples = {
      {text_stl(cube), read_stl},
      {binary_stl(cube), read_stl},
      {binary_ply(std::endian::little, "\n", 10), read_ply},
      {binary_ply(std::endian::big, "\r\n", 10), read_ply},
      {text_ply(vertex_head + face_head, vertex_lines() + face_lines()), read_ply},
      {obj("%/%"), read_obj},
      {gltf().dump(), as_gltf},
      {glb(gltf(), cube_bytes()), as_gltf}};
  std::mt19937 random(5);
  for (const auto& [good, read] : samples) {
    const auto try_it = [&, &read = read](const std::string& bytes) {
      try {
        const Mesh mesh = read(bytes);
        for (const auto& triangle : mesh.triangles)
          for (const int i : triangle)
            ASSERT_TRUE(i >= 0 && static_cast<std::size_t>(i) < mesh.vertices.size());
      } catch (const ReadError& error) {
        EXPECT_LE(std::string(error.what()).size(), 150U);
      }
    };
    for (std::size_t size = 0; size < good.size(); size += 1 + good.size() / 500)
      try_it(good.substr(0, size));
    for (int k = 0; k < 500; ++k) {
      std::string bytes = good;
      for (std::size_t flips = 1 + random() % 3; flips > 0; --flips)
        bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
      try_it(bytes);
    }
  }
}

// In a grasp file.

class MeshCase : public testing::Test {
 protected:
  MeshCase()
      : folder_(fs::path(testing::TempDir()) / ("poise_formats_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "in");
  }
  ~MeshCase() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / "in" / name).string(); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(at(name), std::ios::binary) << bytes;
  }
  /// Held by a jaw of 100 mm about the origin.
  SpatialFile read(const std::string& mesh, const std::string& object = "density: 1000",
                   const std::string& opening = "0.1", const std::string& position = "0") const {
    return std::get<SpatialFile>(grasp_from_yaml(
        "poise: 1\ndimension: 3\nobject: {" + object + ", shape: {mesh: " + mesh +
            "}}\ngripper: {type: parallel_jaw, position: [" + position +
            ", 0, 0], opening: " + opening + ", pad: {width: 0.02, height: 0.02}, friction: 0.5}\n",
        at("f.yaml")));
  }
  std::string problem_of(const std::string& mesh, const std::string& object = "density: 1000",
                         const std::string& opening = "0.1",
                         const std::string& position = "0") const {
    try {
      read(mesh, object, opening, position);
    } catch (const FileError& error) {
      return error.path() + ": " + error.problem();
    }
    return "";
  }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

const std::string by_hand = "mass: 0.2, com: [0, 0, 0]";
const std::string of_cube = "; the object is 0.06 x 0.06 x 0.06 m large, its middle at (0, 0, 0) m";

TEST_F(MeshCase, JawsThatAreFarAwayAreRefused) {
  write_obj(cube, at("cube.obj"));
  const std::string far = " pad is farther than a million times its size from the object";
  EXPECT_EQ(problem_of("cube.obj", by_hand, "0.1", "1.0e+20"), "gripper: the left" + far + of_cube);
  EXPECT_EQ(problem_of("cube.obj", by_hand, "1.0e+20"), "gripper: the left" + far + of_cube);
  EXPECT_EQ(problem_of("{file: cube.obj, scale: 1.0e-20}", "mass: 1, com: [0, 0, 0]"),
            "gripper: the left" + far +
                "; the object is 6e-22 x 6e-22 x 6e-22 m large, its middle at (0, 0, 0) m");
  // As far as allowed it still touches where it should.
  const SpatialFile file = read("cube.obj", by_hand, "1.0e+4");
  for (const Contact<3>& contact : file.contacts)
    EXPECT_NEAR(std::abs(contact.position.x()), 0.03, 1e-9);
  // Millimetres for metres.
  write_obj(moved(cube, Eigen::Affine3d(Eigen::Scaling(1000.0))), at("mm.obj"));
  EXPECT_EQ(problem_of("mm.obj"),
            "gripper: both pads begin inside the object: open wider, or move the gripper; the "
            "object is 60 x 60 x 60 m large, its middle at (0, 0, 0) m");
}

TEST_F(MeshCase, FinsThatStandTwiceAreLeftOut) {
  Mesh fin = cube;
  fin.vertices.emplace_back(0, 0, -0.05);
  fin.triangles.push_back({0, 1, 8});
  fin.triangles.push_back({0, 1, 8});
  write_obj(fin, at("fin.obj"));
  // One triangle three times, two ways and once the other; and a fin of both ways.
  Mesh triple = cube;
  triple.vertices.emplace_back(0, 0, -0.05);
  const auto& [a, b, c] = cube.triangles[0];
  triple.triangles.push_back({a, b, c});
  triple.triangles.push_back({c, b, a});
  triple.triangles.push_back({0, 1, 8});
  triple.triangles.push_back({0, 8, 1});
  write_obj(triple, at("triple.obj"));
  for (const char* mesh : {"fin.obj", "triple.obj"}) {
    const SpatialFile file = read(mesh);
    EXPECT_NEAR(file.loads[0].weight, volume_of_cube * 1000 * standard_gravity, 1e-9) << mesh;
    const Mesh& body = *std::get<MeshShape>(*file.shape).mesh;
    EXPECT_EQ(body.triangles.size(), 12U) << mesh;
    EXPECT_EQ(body.vertices.size(), 8U) << mesh;
    EXPECT_NE(file.warnings.at(0).find("had 2 triangles twice"), std::string::npos)
        << file.warnings[0];
  }
}

TEST_F(MeshCase, VerticesAreFinite) {
  write("nan.obj", replaced(obj("%"), "v 0.03", "v nan"));
  write("large.obj", replaced(obj("%"), "v 0.03", "v 1e999"));
  for (const char* mesh : {"nan.obj", "large.obj"})
    EXPECT_EQ(problem_of(mesh, by_hand),
              "object.shape.mesh: " + std::string(mesh) + " has a vertex that is not finite");
  write("huge.obj", replaced(obj("%"), "v 0.03", "v 1e300"));
  EXPECT_EQ(problem_of("huge.obj", by_hand),
            "object.shape.mesh: huge.obj has a size of 5e+299 m, too large to compute with");
}

TEST_F(MeshCase, APadThatMeetsASurfaceFromBehindIsWarnedOf) {
  Mesh open = cube;  // without its side at -x: the left pad goes in there
  std::erase_if(open.triangles, [&](const auto& triangle) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](int i) { return cube.vertices[static_cast<std::size_t>(i)].x() < 0; });
  });
  write_obj(open, at("open.obj"));
  const SpatialFile file = read("open.obj", by_hand);
  ASSERT_EQ(file.warnings.size(), 2U);
  EXPECT_NE(file.warnings[1].find("gripper: contact 0 meets the surface from behind: it is "
                                  "open there, or faces the wrong way"),
            std::string::npos)
      << file.warnings[1];
  write_obj(cube, at("cube.obj"));
  EXPECT_EQ(read("cube.obj").warnings, std::vector<std::string>());
}

TEST_F(MeshCase, OutsideItsBoxIsOutside) {
  // A prism on a bow tie, which crosses itself; the pads are 100 mm away.
  const double x[] = {-0.04, 0.02, 0.02, -0.04}, y[] = {-0.03, 0.015, -0.015, 0.03};
  Mesh mesh;
  for (const double z : {-0.03, 0.03})
    for (int k = 0; k < 4; ++k) mesh.vertices.emplace_back(x[k], y[k], z);
  for (int i = 0; i < 4; ++i) {
    const int k = (i + 1) % 4;
    mesh.triangles.push_back({i, k, k + 4});
    mesh.triangles.push_back({i, k + 4, i + 4});
  }
  for (const auto& triangle : {std::array{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}})
    mesh.triangles.push_back(triangle);
  write_obj(mesh, at("bow-tie.obj"));
  const SpatialFile file = std::get<SpatialFile>(grasp_from_yaml(
      "poise: 1\ndimension: 3\nobject: {density: 1000, shape: {mesh: bow-tie.obj}}\n"
      "gripper: {type: parallel_jaw, position: [0.014, 0, 0], quaternion: [0.70710678, 0, 0, "
      "0.70710678],\n  opening: 0.2, pad: {width: 0.006, height: 0.02, depth: 0.006}, friction: "
      "0.5}\n",
      at("f.yaml")));
  EXPECT_FALSE(file.contacts.empty());
}

TEST_F(MeshCase, OnlyRegularFilesOfItsFolderAreRead) {
  const auto with_uri = [&](const std::string& uri) {
    Json json = gltf();
    json["buffers"][0]["uri"] = uri;
    write("part.gltf", json.dump());
    return problem_of("part.gltf", by_hand);
  };
  write("my part.bin", cube_bytes());
  fs::create_directory(folder() / "in/sub");
  write("sub/part.bin", cube_bytes());
  std::ofstream(folder() / "other.bin", std::ios::binary) << cube_bytes();
  EXPECT_EQ(with_uri("my%20part.bin"), "");
  EXPECT_EQ(with_uri("sub/../sub/part.bin"), "");
  const auto refused = [](const std::string& name, const std::string& why) {
    return "object.shape.mesh: part.gltf names " + name + ", which " + why;
  };
  const std::string outside = "is not in the folder of the mesh or beneath";
  EXPECT_EQ(with_uri("../other.bin"), refused("../other.bin", outside));
  EXPECT_EQ(with_uri("%2e%2e/other.bin"), refused("../other.bin", outside));
  EXPECT_EQ(with_uri("/dev/zero"), refused("/dev/zero", outside));
  fs::create_symlink(folder() / "other.bin", folder() / "in/link.bin");
  EXPECT_EQ(with_uri("link.bin"), refused("link.bin", outside));
  ASSERT_EQ(mkfifo(at("pipe.bin").c_str(), 0600), 0);
  EXPECT_EQ(with_uri("pipe.bin"), refused("pipe.bin", "is not a regular file"));
  EXPECT_EQ(with_uri("none.bin"), refused("none.bin", "does not exist"));
  EXPECT_EQ(with_uri("https://example.org/a.bin"),
            refused("https://example.org/a.bin", "does not exist"));
  // Nothing that an OBJ names is opened.
  ASSERT_EQ(mkfifo(at("pipe.mtl").c_str(), 0600), 0);
  write("part.obj", "mtllib pipe.mtl\n" + obj("%"));
  EXPECT_EQ(problem_of("part.obj"), "");
  ASSERT_EQ(mkfifo(at("pipe.stl").c_str(), 0600), 0);
  EXPECT_EQ(problem_of("pipe.stl"), "object.shape.mesh: pipe.stl is not a regular file");
}

TEST_F(MeshCase, APointerIsNotTheFile) {
  write("part.obj", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 123456\n");
  EXPECT_EQ(problem_of("part.obj"),
            "object.shape.mesh: part.obj is a pointer of Git LFS, not the file: git lfs pull gets "
            "that");
}

}  // namespace
}  // namespace poise
