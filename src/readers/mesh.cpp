#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>

#include "readers/regular_file.hpp"

namespace poise::readers {
namespace {

void check_ending(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto known = {".stl", ".obj", ".ply", ".gltf", ".glb"};
  if (std::find(known.begin(), known.end(), ending) == known.end())
    throw ReadError("is of no known kind, must be .stl, .obj, .ply, .gltf or .glb");
}

Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
  Eigen::Matrix4d result;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      result(static_cast<int>(row), static_cast<int>(column)) = m[row][column];
  return result;
}

void add(const aiMesh& part, const Eigen::Matrix4d& place, Mesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices.emplace_back((place * Eigen::Vector4d(v.x, v.y, v.z, 1)).head<3>());
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines bound nothing
    std::array<int, 3> triangle{};
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices)
        throw ReadError("names a vertex that is not there");
      triangle[k] = first + static_cast<int>(face.mIndices[k]);
    }
    mesh.triangles.push_back(triangle);
  }
}

void add(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& above, Mesh& mesh) {
  const Eigen::Matrix4d place = above * matrix(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene.mMeshes[node.mMeshes[i]], place, mesh);
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], place, mesh);
}

}  // namespace

Mesh read_mesh(const std::string& file) {
  check_regular_file(file);
  check_ending(file);
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(file, aiProcess_Triangulate);
  if (!scene || !scene->mRootNode)
    throw ReadError(std::string("cannot be read: ") + importer.GetErrorString());
  Mesh mesh;
  add(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), mesh);
  return mesh;
}

}  // namespace poise::readers
