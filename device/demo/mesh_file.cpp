// Mesh files through assimp.
#include "mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>
#include <vector>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
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

/// Opens nothing: a mesh that somebody sent names no file of this machine, as OBJ does with its materials.
class NoFiles final : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

/// Everything but positions is dropped first: corners that differ in normal or colour only are then joined.
constexpr unsigned assimp_steps = aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices;
void drop_all_but_positions(Assimp::Importer& importer) {
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                                          aiComponent_TEXCOORDS | aiComponent_TEXTURES | aiComponent_MATERIALS);
}

/// @param scene  null where the file was not understood; the reader's own words say nothing to a user
Mesh mesh_of(const aiScene* scene, const std::string& name, double scale) {
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw BadInput("The file " + name +
                   " cannot be read as a mesh: it is damaged, or of another kind than its name says. Export it again, as STL, OBJ, PLY or OFF.");
  MeshGatherer gatherer(*scene);
  gatherer.add(*scene->mRootNode, aiMatrix4x4());
  Mesh mesh = gatherer.mesh(scale);
  if (mesh.triangles.rows() == 0) throw BadInput("The file " + name + " has no triangles: export a surface, not points or lines.");
  if (!mesh.vertices.allFinite())
    throw BadInput("The file " + name + " has a coordinate that is NaN or infinite: repair the mesh and export it again.");
  return mesh;
}

/// The ending of a name that says what is in a file, in small letters.
std::string kind_of(const std::string& name) {
  std::string kind = std::filesystem::path(name).extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return kind;
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& file, double scale) {
  check_file(file);
  Assimp::Importer importer;
  drop_all_but_positions(importer);
  return mesh_of(importer.ReadFile(file.string(), assimp_steps), file.string(), scale);
}

Mesh read_mesh(const std::string& bytes, const std::string& name) {
  const std::string kind = kind_of(name);
  if (kind != ".stl" && kind != ".obj" && kind != ".ply" && kind != ".off")
    throw BadInput("The file " + name + " is of no kind that is read here: give an STL, OBJ, PLY or OFF file.");
  if (bytes.empty()) throw BadInput("The file " + name + " is empty: export the mesh again.");
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // which the importer owns
  drop_all_but_positions(importer);
  return mesh_of(importer.ReadFileFromMemory(bytes.data(), bytes.size(), assimp_steps, kind.c_str() + 1), name, 1.0);
}

}  // namespace feeler::demo
