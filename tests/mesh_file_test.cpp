// Meshes and robot models that a grasp file names.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "files/grasp_file.hpp"
#include "files/grasp_writer.hpp"
#include "meshes.hpp"

namespace poise {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

const Mesh box =
    moved(box_mesh({0.06, 0.08, 0.1}), Eigen::Affine3d(Eigen::Translation3d(0.01, 0, -0.02)));
const Vector<3> middle(0.04, 0.04, 0.03);
const double weight_of_water = 0.06 * 0.08 * 0.1 * 1000 * standard_gravity;

template <class Number>
void put(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

class MeshFile : public testing::Test {
 protected:
  MeshFile() : folder_(fs::path(testing::TempDir()) / ("poise_mesh_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~MeshFile() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(at(name), std::ios::binary) << text;
  }
  void write(const std::string& name, const Mesh& mesh) const { write_obj(mesh, at(name)); }

  void write_ascii_stl(const std::string& name, const Mesh& mesh) const {
    std::ofstream out(at(name));
    out.precision(9);
    out << "solid part\n";
    for (const auto& triangle : mesh.triangles) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const int i : triangle)
        out << "vertex " << mesh.vertices[static_cast<std::size_t>(i)].transpose() << '\n';
      out << "endloop\nendfacet\n";
    }
    out << "endsolid part\n";
  }
  void write_binary_stl(const std::string& name, const Mesh& mesh) const {
    std::string bytes(80, ' ');
    put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
      bytes.append(12, '\0');
      for (const int i : triangle)
        for (const double x : mesh.vertices[static_cast<std::size_t>(i)])
          put(bytes, static_cast<float>(x));
      bytes.append(2, '\0');
    }
    write(name, bytes);
  }
  void write_ply(const std::string& name, const Mesh& mesh) const {
    std::ofstream out(at(name));
    out.precision(9);
    out << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
        << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& v : mesh.vertices) out << v.transpose() << '\n';
    for (const auto& [i, j, k] : mesh.triangles) out << "3 " << i << ' ' << j << ' ' << k << '\n';
  }
  /// In a node that moves by `step` and makes it `scale` times as large.
  void write_gltf(const std::string& name, const Mesh& mesh, const Vector<3>& step,
                  double scale) const {
    std::string bytes;
    for (const auto& triangle : mesh.triangles)
      for (const int i : triangle) put(bytes, static_cast<std::uint32_t>(i));
    const std::size_t indices = bytes.size();
    for (const auto& v : mesh.vertices)
      for (const double x : v) put(bytes, static_cast<float>(x));
    std::ofstream(at(name)) << R"({"asset": {"version": "2.0"}, "scene": 0,
      "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "translation": [)"
                            << step.x() << "," << step.y() << "," << step.z() << R"(], "scale": [)"
                            << scale << "," << scale << "," << scale << R"(]}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}],
      "buffers": [{"byteLength": )"
                            << bytes.size() << R"(, "uri": "data:application/octet-stream;base64,)"
                            << base64(bytes) << R"("}],
      "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": )"
                            << indices << R"(}, {"buffer": 0, "byteOffset": )" << indices
                            << R"(, "byteLength": )" << bytes.size() - indices << R"(}],
      "accessors": [{"bufferView": 0, "componentType": 5125, "count": )"
                            << 3 * mesh.triangles.size() << R"(, "type": "SCALAR"},
        {"bufferView": 1, "componentType": 5126, "count": )"
                            << mesh.vertices.size() << R"(, "type": "VEC3",
         "min": [-1, -1, -1], "max": [1, 1, 1]}]})";
  }

  SpatialFile read(const std::string& object, const std::string& rest) const {
    return std::get<SpatialFile>(grasp_from_yaml(
        "poise: 1\ndimension: 3\n" + rest + "\nobject: " + object + "\n", at("f.yaml")));
  }
  static inline const std::string somewhere =
      "contacts: [{position: [0, 0, 0], normal: [0, 0, 1], friction: 1}]";

  /// The error without the folder.
  std::string problem(const std::string& object, const std::string& rest = somewhere) const {
    try {
      read(object, rest);
    } catch (const FileError& error) {
      return located("", {}, error.path(), error.problem()).substr(2);
    }
    return "";
  }
  /// Warnings of the mesh, without the file.
  static Strings of_mesh(const SpatialFile& file) {
    Strings lines;
    for (const std::string& line : file.warnings)
      if (const auto mesh = line.find("object.shape.mesh"); mesh != std::string::npos)
        lines.push_back(line.substr(mesh));
    return lines;
  }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

TEST_F(MeshFile, EveryFormatIsTheSameBody) {
  write("box.obj", box);
  write_ascii_stl("ascii.stl", box);
  write_binary_stl("binary.STL", box);
  write_ply("box.ply", box);
  write_gltf("box.gltf", moved(box, Eigen::Affine3d(Eigen::Translation3d(0.5, 0, 0))), {-1, 0, 0},
             2);
  for (const std::string file : {"box.obj", "ascii.stl", "binary.STL", "box.ply", "box.gltf"}) {
    const SpatialFile read_file = read("{density: 1000, shape: {mesh: " + file + "}}", somewhere);
    const double scale = file == "box.gltf" ? 2 : 1;
    EXPECT_EQ(of_mesh(read_file), Strings()) << file;
    ASSERT_EQ(read_file.loads.size(), 1U);
    EXPECT_NEAR(read_file.loads[0].weight, std::pow(scale, 3) * weight_of_water, 1e-5) << file;
    EXPECT_LE((read_file.loads[0].com - scale * middle).norm(), 1e-7) << file;
    EXPECT_EQ(std::get<MeshShape>(*read_file.shape).mesh->vertices.size(), 8U) << file;
  }
}

TEST_F(MeshFile, HasTheUnitOfTheFileOrAScaleOfItsOwn) {
  write("box.obj", moved(box, Eigen::Affine3d(Eigen::Scaling(1000.0))));
  for (const std::string head : {"length_unit: mm", "length_unit: in", "", "length_unit: cm"})
    for (const std::string scale : {"", ", scale: 0.002"}) {
      const SpatialFile file =
          read("{density: 1000, shape: {mesh: {file: box.obj" + scale + "}}}",
               head + "\ncontacts: [{position: [1, 1, 1], normal: [0, 0, 1], friction: 1}]");
      const double unit = head.empty()                           ? 1
                          : head.find("mm") != std::string::npos ? 0.001
                          : head.find("in") != std::string::npos ? 0.0254
                                                                 : 0.01;
      const double times = 1000 * (scale.empty() ? unit : 0.002);
      EXPECT_NEAR(file.loads[0].weight / (weight_of_water * std::pow(times, 3)), 1, 1e-6);
      EXPECT_LE((file.loads[0].com - times * middle).norm(), 1e-7 * times);
      EXPECT_TRUE(file.contacts[0].position.isApprox(Vector<3>::Constant(unit)));
      EXPECT_NEAR(std::get<MeshShape>(*file.shape).scale, times / 1000, 1e-15);
    }
}

TEST_F(MeshFile, GivenComAndWeightComeFirst) {
  write("box.obj", box);
  const SpatialFile file =
      read("{mass: 2, com: [0.02, 0.03, 0.04], shape: {mesh: box.obj}}", somewhere);
  EXPECT_EQ(file.loads[0].weight, 2 * standard_gravity);
  EXPECT_EQ(file.loads[0].com, Vector<3>(0.02, 0.03, 0.04));
}

TEST_F(MeshFile, LoadsMayHaveDensities) {
  write("box.obj", box);
  const SpatialFile file = read(
      "{shape: {mesh: box.obj}}",
      "loads: [{density: 1000}, {density: 500, com: [0, 0, 0]}, {weight: 3}]\n" + somewhere);
  ASSERT_EQ(file.loads.size(), 3U);
  EXPECT_NEAR(file.loads[0].weight, weight_of_water, 1e-5);
  EXPECT_NEAR(file.loads[1].weight, weight_of_water / 2, 1e-5);
  EXPECT_LE((file.loads[2].com - middle).norm(), 1e-7);
  EXPECT_EQ(file.loads[1].com, Vector<3>(0, 0, 0));
}

TEST_F(MeshFile, DensityOfSolidsToo) {
  const double pi = std::acos(-1.0);
  for (const auto& [shape, volume] : {std::pair<std::string, double>("box: {size: [1, 2, 3]}", 6),
                                      {"cylinder: {radius: 2, height: 3}", 12 * pi},
                                      {"sphere: {radius: 3}", 36 * pi},
                                      {"ellipsoid: {radii: [1, 2, 3]}", 8 * pi}})
    EXPECT_NEAR(read("{density: 2, shape: {" + shape + "}}", somewhere).loads[0].weight,
                2 * volume * standard_gravity, 1e-11);
}

TEST_F(MeshFile, SaysWhatItMended) {
  write("inverted.obj", inside_out(box));
  const SpatialFile file = read("{density: 1000, shape: {mesh: inverted.obj}}", somewhere);
  EXPECT_EQ(of_mesh(file),
            Strings{"object.shape.mesh: inverted.obj was inside out, and was turned"});
  EXPECT_EQ(file.warnings[0].substr(at("f.yaml").size(), 6), ":4:39:");
  EXPECT_NEAR(file.loads[0].weight, weight_of_water, 1e-5);
}

TEST_F(MeshFile, AnOpenOneNeedsComAndWeight) {
  Mesh open = box;
  open.triangles.pop_back();
  write("open.obj", open);
  const std::string why = "is not closed: 3 edges of its 11 triangles belong to one triangle only";
  EXPECT_EQ(problem("{density: 1000, shape: {mesh: open.obj}}"),
            "object.density: needs a volume, but the mesh " + why + ": give weight or mass");
  EXPECT_EQ(problem("{mass: 1, shape: {mesh: open.obj}}"),
            "object.com: is missing, must be [x, y, z], as the mesh " + why);
  const SpatialFile file = read("{mass: 1, com: [0, 0, 0], shape: {mesh: open.obj}}", somewhere);
  EXPECT_EQ(of_mesh(file), Strings{"object.shape.mesh: open.obj " + why +
                                   "; so it has neither volume nor inside, but a surface to "
                                   "touch"});
  EXPECT_EQ(problem("{mass: 1, com: [0, 0, 0], shape: {mesh: open.obj}}",
                    "contacts: [{position: [0.01, 0.02, 0.01], friction: 1}]"),
            "contacts[0].position: is on a mesh that is not closed, so that no side is in, give "
            "the normal");
}

TEST_F(MeshFile, NormalsAreThoseOfTheMesh) {
  write("box.obj", box);
  const auto contact = [&](const std::string& position) {
    return problem("{mass: 1, shape: {mesh: box.obj}}",
                   "contacts: [{position: " + position + ", friction: 1}]");
  };
  const SpatialFile file =
      read("{mass: 1, shape: {mesh: box.obj}}",
           "contacts: [{position: [0.01, 0.02, 0.01], friction: 1}, {position: [0.04, 0.03, 0.08], "
           "friction: 1}, {position: [0.04, 0.04, 0.08], friction: 1}]");
  EXPECT_TRUE(file.contacts[0].normal.isApprox(Vector<3>(1, 0, 0), 1e-6));
  EXPECT_TRUE(file.contacts[1].normal.isApprox(Vector<3>(0, 0, -1), 1e-6));
  // In the middle of a face: on the line between its two triangles, which lie in one plane.
  EXPECT_TRUE(file.contacts[2].normal.isApprox(Vector<3>(0, 0, -1), 1e-6));
  EXPECT_NE(
      contact("[0.01, 0, 0.01]").find("contacts[0].position: is on the edge between triangles"),
      std::string::npos)
      << contact("[0.01, 0, 0.01]");
  EXPECT_EQ(contact("[0.01, 0.02, 0.09]"),
            "contacts[0].position: is 0.01 m from the boundary of the shape, must be within "
            "7.07e-06 m of it, or give the normal");
}

TEST_F(MeshFile, TheNormalsOfAFineMeshAreThoseOfItsShape) {
  write("cylinder.obj", cylinder_mesh(0.03, 0.1, 720));
  for (int k = 0; k < 20; ++k) {
    const double a = 0.31 * k + 0.001;
    std::ostringstream place;
    place.precision(17);
    place << "[" << 0.03 * std::cos(a) << ", " << 0.03 * std::sin(a) << ", " << 0.002 * k - 0.02
          << "]";
    const SpatialFile file = read("{mass: 1, shape: {mesh: cylinder.obj}}",
                                  "contacts: [{position: " + place.str() + ", friction: 1}]");
    EXPECT_LE((file.contacts[0].normal + Vector<3>(std::cos(a), std::sin(a), 0)).norm(), 0.005);
  }
}

TEST_F(MeshFile, WarnsOfContactsOffTheMesh) {
  write("box.obj", box);
  EXPECT_EQ(
      read("{mass: 1, shape: {mesh: box.obj}}",
           "contacts:\n"
           "  - {position: [0, 0.02, 0.01], normal: [1, 0, 0], friction: 1}\n"
           "  - {position: [0.07, 0.02, 0.01], normal: [1, 0, 0], friction: 1}\n")
          .warnings,
      (Strings{
          at("f.yaml") + ":4:16: contacts[0].position: is 0.01 m from the boundary of the shape",
          at("f.yaml") + ":5:44: contacts[1].normal: is 180 degrees away from the inward "
                         "normal of the shape"}));
}

TEST_F(MeshFile, WhatIsNoMesh) {
  const auto mesh = [&](const std::string& file) {
    return problem("{mass: 1, com: [0, 0, 0], shape: {mesh: " + file + "}}");
  };
  write("text.obj", std::string("this is no mesh\n"));
  write("part.step", std::string("ISO-10303-21;\n"));
  write("half.stl", std::string("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"));
  write("empty.obj", Mesh{});
  EXPECT_EQ(mesh("none.stl"), "object.shape.mesh: none.stl does not exist");
  EXPECT_EQ(mesh("part.step"),
            "object.shape.mesh: part.step is of no known kind, must be .stl, .obj, .ply, .gltf or "
            ".glb");
  for (const std::string file : {"text.obj", "half.stl", "empty.obj"}) {
    const std::string why = mesh(file);
    EXPECT_TRUE(why.find(file + " cannot be read: ") != std::string::npos ||
                why.find(file + " has no triangles") != std::string::npos)
        << why;
  }
  write("tiny.obj", moved(box, Eigen::Affine3d(Eigen::Scaling(1e-30))));
  EXPECT_NE(mesh("{file: tiny.obj, scale: 1e-140}").find("too small to compute with"),
            std::string::npos);
}

TEST_F(MeshFile, GripsAreWrittenAsContactsAndReadBack) {
  write("box.obj", box);
  const SpatialFile file =
      read("{density: 800, shape: {mesh: {file: box.obj, scale: 1}}}",
           "name: held\nup: [0, 3, 4]\nsafety: 1.5\ntilt: {from: [0, 0, 1], max_deg: 30}\n"
           "gripper: {type: parallel_jaw, position: [0.04, 0.04, 0.03], quaternion: [1, 0, 0, 0],\n"
           "  opening: 0.08, pad: {width: 0.02, height: 0.04}, friction: 0.6,\n"
           "  samples: 8, max_force: 40}\nfingers: {left: {max_force: 30}}\n");
  ASSERT_EQ(file.contacts.size(), 2U);
  EXPECT_EQ(file.grasp().drives()[0].max, 30);
  EXPECT_EQ(file.warnings, Strings());
  for (const WriteAs held : {WriteAs::contacts, WriteAs::gripper}) {
    fs::create_directories(folder() / "sub");
    const std::string text = grasp_document(file, held, at("sub"));
    const SpatialFile back = std::get<SpatialFile>(grasp_from_json(text, at("sub/back.json")));
    EXPECT_EQ(back.gripper.has_value(), held == WriteAs::gripper);
    EXPECT_EQ(back.warnings, Strings()) << text;
    EXPECT_EQ(back.name, "held");
    EXPECT_EQ(back.safety, 1.5);
    EXPECT_TRUE(back.up->isApprox(*file.up, 1e-15));
    EXPECT_NEAR(back.tilt->most, file.tilt->most, 1e-15);
    EXPECT_EQ(back.loads[0].weight, file.loads[0].weight);
    EXPECT_EQ(back.loads[0].com, file.loads[0].com);
    EXPECT_EQ(std::get<MeshShape>(*back.shape).mesh->vertices,
              std::get<MeshShape>(*file.shape).mesh->vertices);
    ASSERT_EQ(back.contacts.size(), file.contacts.size());
    for (std::size_t i = 0; i < file.contacts.size(); ++i) {
      const Contact<3>&a = file.contacts[i], &b = back.contacts[i];
      EXPECT_EQ(a.position, b.position);
      EXPECT_TRUE(a.normal.isApprox(b.normal, 1e-15));
      EXPECT_EQ(a.friction, b.friction);
      EXPECT_EQ(a.finger, b.finger);
      EXPECT_EQ(a.pad->points, b.pad->points);
      EXPECT_EQ(a.pad->shares, b.pad->shares);
      EXPECT_EQ(a.pad->reach, b.pad->reach);
      EXPECT_TRUE(a.pad->axis.isApprox(b.pad->axis, 1e-15));
    }
    EXPECT_EQ(back.mechanism.kind, file.mechanism.kind);
    ASSERT_EQ(back.mechanism.fingers.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      const Finger<3>&a = file.mechanism.fingers[k], &b = back.mechanism.fingers[k];
      EXPECT_EQ(a.name, b.name);
      EXPECT_TRUE(a.closing.isApprox(b.closing, 1e-15));
      EXPECT_EQ(a.max_force, b.max_force);
    }
  }
}

TEST_F(MeshFile, GrippersHaveTheUnitOfTheFile) {
  write("box.obj", box);
  const SpatialFile file = read(
      "{mass: 1, shape: {mesh: {file: box.obj, scale: 1}}}",
      "length_unit: mm\n"
      "gripper: {type: parallel_jaw, position: [40, 40, 30], quaternion: [0, 0, 0, 2],\n"
      "  opening: 80, pad: {width: 20, height: 40, depth: 2}, friction: 0.6, contact: facets,\n"
      "  torsion: 3}\n");
  const auto& jaw = std::get<ParallelJaw>(*file.gripper);
  EXPECT_TRUE(jaw.pose.position.isApprox(middle + Vector<3>(0, 0, 0), 1e-15));
  EXPECT_DOUBLE_EQ(jaw.opening, 0.08);
  EXPECT_DOUBLE_EQ(jaw.width, 0.02);
  EXPECT_DOUBLE_EQ(jaw.height, 0.04);
  EXPECT_DOUBLE_EQ(jaw.depth, 0.002);
  EXPECT_DOUBLE_EQ(jaw.torsion, 0.003);
  EXPECT_EQ(jaw.samples, 16);
  EXPECT_FALSE(std::isfinite(jaw.max_force));
  // Half a turn about z: left is right.
  EXPECT_NEAR(file.contacts.front().position.x(), 0.07, 1e-7);
  EXPECT_EQ(file.contacts.front().finger, "left");
}

const std::string robot = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="cup">
    <inertial>
      <origin xyz="0.1 -0.2 0.3" rpy="0.5 0.6 0.7"/>
      <mass value="1.5"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
  </link>
  <link name="air"/>
  <joint name="a" type="fixed">
    <parent link="base"/><child link="cup"/><origin xyz="5 5 5" rpy="1 1 1"/>
  </joint>
  <joint name="b" type="fixed"><parent link="cup"/><child link="air"/></joint>
</robot>
)";

TEST_F(MeshFile, ARobotModelKnowsMassAndCom) {
  write("arm.urdf", robot);
  // In metres, in the frame of the link: neither the joint nor the turn of the inertial moves it.
  const SpatialFile file =
      read("{inertial: {urdf: arm.urdf, link: cup}}", "length_unit: mm\n" + somewhere);
  EXPECT_EQ(file.loads[0].weight, 1.5 * standard_gravity);
  EXPECT_EQ(file.loads[0].com, Vector<3>(0.1, -0.2, 0.3));
  const SpatialFile more =
      read("{weight: 1, com: [0, 0, 0]}",
           "loads: [{inertial: {urdf: arm.urdf, link: cup}}, {name: plain}]\n" + somewhere);
  EXPECT_EQ(more.loads[0].weight, 1.5 * standard_gravity);
  EXPECT_EQ(problem("{inertial: {urdf: arm.urdf, link: cap}}"),
            "object.inertial.urdf: arm.urdf has no link cap, its links are air, base, cup");
  EXPECT_EQ(problem("{inertial: {urdf: arm.urdf, link: air}}"),
            "object.inertial.urdf: arm.urdf has no inertial in its link air");
  write("no.urdf", std::string("<robot>"));
  EXPECT_EQ(problem("{inertial: {urdf: no.urdf, link: cup}}"),
            "object.inertial.urdf: no.urdf is not a robot model (URDF)");
  std::string deep = "<robot name=\"a\">";
  for (int k = 0; k < 200000; ++k) deep += "<a b=\"/>\">";
  write("deep.urdf", deep);
  EXPECT_EQ(problem("{inertial: {urdf: deep.urdf, link: cup}}"),
            "object.inertial.urdf: deep.urdf is nested too deeply for a robot model");
}

// The data sets, where they are.

std::string data_folder(const std::string& part) {
  const char* const root = std::getenv("POISE_DATA");
  return root && fs::is_directory(fs::path(root) / part) ? (fs::path(root) / part).string() : "";
}

/// The integral over a body of 1, x, y and z, by how often columns of rays go in and out of it.
Eigen::Vector4d by_columns(const Mesh& mesh, int columns) {
  const Eigen::AlignedBox3d in = bounds(mesh);
  const Vector<3> size = in.sizes();
  const auto index_of = [&](int column, int row) {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(row);
  };
  std::vector<double> sums(2 * index_of(columns, 0), 0.0);
  const double dx = size.x() / columns, dy = size.y() / columns;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector<3>&a = mesh.vertices[static_cast<std::size_t>(i)],
          &b = mesh.vertices[static_cast<std::size_t>(j)],
          &c = mesh.vertices[static_cast<std::size_t>(k)];
    const auto cross = [](const Vector<3>& u, const Vector<3>& v, double x, double y) {
      return (v.x() - u.x()) * (y - u.y()) - (v.y() - u.y()) * (x - u.x());
    };
    const double twice = cross(a, b, c.x(), c.y());
    if (twice == 0) continue;
    const auto index = [&](double at, double low, double step) {
      return std::clamp(static_cast<int>((at - low) / step), 0, columns - 1);
    };
    const int i0 = index(std::min({a.x(), b.x(), c.x()}), in.min().x(), dx),
              i1 = index(std::max({a.x(), b.x(), c.x()}), in.min().x(), dx),
              j0 = index(std::min({a.y(), b.y(), c.y()}), in.min().y(), dy),
              j1 = index(std::max({a.y(), b.y(), c.y()}), in.min().y(), dy);
    for (int column = i0; column <= i1; ++column)
      for (int row = j0; row <= j1; ++row) {
        const double x = in.min().x() + (column + 0.5001) * dx,
                     y = in.min().y() + (row + 0.5003) * dy;
        const double u = cross(b, c, x, y) / twice, v = cross(c, a, x, y) / twice,
                     w = cross(a, b, x, y) / twice;
        if (u < 0 || v < 0 || w < 0) continue;
        const double z = u * a.z() + v * b.z() + w * c.z() - in.min().z();
        const std::size_t at = 2 * index_of(column, row);
        sums[at] += twice > 0 ? z : -z;
        sums[at + 1] += (twice > 0 ? z : -z) * z / 2;
      }
  }
  Eigen::Vector4d total = Eigen::Vector4d::Zero();
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < columns; ++row) {
      const std::size_t at = 2 * index_of(column, row);
      total += dx * dy *
               Eigen::Vector4d(sums[at], sums[at] * (in.min().x() + (column + 0.5001) * dx),
                               sums[at] * (in.min().y() + (row + 0.5003) * dy),
                               sums[at + 1] + sums[at] * in.min().z());
    }
  return total;
}

TEST_F(MeshFile, OddOnesAreReadRightOrRefused) {
  const std::string odd = data_folder("meshes-odd");
  if (odd.empty()) GTEST_SKIP() << "POISE_DATA has no meshes-odd";
  int files = 0, closed = 0;
  for (const auto& entry : fs::directory_iterator(odd)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".md") continue;
    ++files;
    const std::string mesh = "shape: {mesh: {file: '" + path.string() + "', scale: 1}}";
    const std::string refused = problem("{mass: 1, " + mesh + "}");
    if (!refused.empty()) {
      EXPECT_TRUE(refused.find("is not closed") != std::string::npos ||
                  refused.find("has no triangles") != std::string::npos ||
                  refused.find("parts that may overlap") != std::string::npos)
          << refused;
      continue;
    }
    ++closed;
    const SpatialFile file = read("{mass: 1, " + mesh + "}", somewhere);
    const auto& shape = std::get<MeshShape>(*file.shape);
    const Eigen::Vector4d sums = by_columns(*shape.mesh, 800);
    EXPECT_NEAR(sums[0] / volume(*shape.mesh), 1, 0.01) << path;
    EXPECT_LE((sums.tail<3>() / sums[0] - file.loads[0].com).norm(), 0.003 * size(Solid(shape)))
        << path;
  }
  EXPECT_EQ(files, 22);
  EXPECT_GE(closed, 9);
}

TEST_F(MeshFile, MassesAreThosePublished) {
  const std::string parts = data_folder("mass-properties");
  if (parts.empty()) GTEST_SKIP() << "POISE_DATA has no mass-properties";
  std::ifstream in(parts + "/mass_properties.json");
  for (const auto& part : nlohmann::json::parse(in)) {
    const double inch = 0.0254, pound = 0.45359237;
    const double density = part["density"].get<double>() * pound / std::pow(inch, 3);
    const SpatialFile file = read("{density: " + std::to_string(density) + ", shape: {mesh: '" +
                                      parts + "/" + part["filename"].get<std::string>() + "'}}",
                                  "length_unit: in\n" + somewhere);
    // The mesh is a little off the body whose numbers these are.
    EXPECT_NEAR(file.loads[0].weight / standard_gravity / pound / part["mass"].get<double>(), 1,
                1e-3);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(file.loads[0].com[k] / inch,
                  part["center_mass"][static_cast<std::size_t>(k)].get<double>(), 1.5e-3);
  }
}

}  // namespace
}  // namespace poise
