// Mesh files through assimp.
#include "mesh_file.hpp"

#include <cmath>
#include <system_error>
#include <vector>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "bad_input.hpp"

namespace feeler::demo {
namespace {

void check_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    throw BadInput("The file " + file.string() + " does not exist: check the path.");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw BadInput(file.string() + " is no file: give an STL, OBJ, PLY or OFF file.");
  }
  if (std::filesystem::file_size(file, error) == 0) {
    throw BadInput("The file " + file.string() + " is empty: export the mesh again.");
  }
}

/// Gathers the triangles of a node and of those below it.
class MeshGatherer {
 public:
  explicit MeshGatherer(const aiScene& scene) : scene_(scene) {}

  void add(const aiNode& node, const aiMatrix4x4& world_from_parent) {
    const aiMatrix4x4 world_from_node = world_from_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], world_from_node);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], world_from_node);
  }

  Mesh mesh(double scale) const {
    Mesh mesh{Points<double>(Eigen::Index(vertices_.size()), 3), Triangles(Eigen::Index(triangles_.size()), 3)};
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      mesh.vertices.row(Eigen::Index(i)) = scale * vertices_[i].transpose();
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      mesh.triangles.row(Eigen::Index(i)) = triangles_[i].transpose();
    }
    return mesh;
  }

 private:
  void add(const aiMesh& mesh, const aiMatrix4x4& world_from_mesh) {
    const int first = int(vertices_.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D v = world_from_mesh * mesh.mVertices[i];
      vertices_.emplace_back(double(v.x), double(v.y), double(v.z));
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // a point or a line: it has no surface to touch
      triangles_.emplace_back(first + int(face.mIndices[0]), first + int(face.mIndices[1]), first + int(face.mIndices[2]));
    }
  }

  const aiScene& scene_;
  std::vector<Vector3<double>> vertices_;
  std::vector<Eigen::Vector3i> triangles_;
};

}  // namespace

Mesh load_mesh(const std::filesystem::path& file, double scale) {
  check_file(file);
  Assimp::Importer importer;
  // Everything but positions is dropped first: corners that differ in normal or colour only are then joined.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                                          aiComponent_TEXCOORDS | aiComponent_TEXTURES | aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw BadInput("The file " + file.string() + " cannot be read as a mesh (" + importer.GetErrorString() + "): give an STL, OBJ, PLY or OFF file.");
  }
  MeshGatherer gatherer(*scene);
  gatherer.add(*scene->mRootNode, aiMatrix4x4());
  Mesh mesh = gatherer.mesh(scale);
  if (mesh.triangles.rows() == 0) {
    throw BadInput("The file " + file.string() + " has no triangles: export a surface, not points or lines.");
  }
  if (!mesh.vertices.allFinite()) {
    throw BadInput("The file " + file.string() + " has a coordinate that is NaN or infinite: repair the mesh and export it again.");
  }
  return mesh;
}

}  // namespace feeler::demo
