// SPDX-License-Identifier: BSD-3-Clause
#include "people/person_mesh.h"

#include "flyball/sim/person.h"

#include "world/import_process.h"
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <optional>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace flyball {
namespace {

struct Look {
  const char* name;
  const char* file;
  const char* meshes;  ///< How the names of the person's meshes begin; the file has others too.
};
constexpr std::array<Look, 2> looks{
    {{"walker", "human_rig.blend", "man1-"}, {"victim", "victim.blend", "Injured"}}};

const Look* find_look(const std::string& name) {
  const auto* found =
      std::find_if(looks.begin(), looks.end(), [&](const Look& look) { return name == look.name; });
  return found == looks.end() ? nullptr : found;
}

Eigen::Vector3f vector_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// How a person's mesh comes from the process that reads the file: parts' pictures are still PNG
/// files, or the three floats of a plain colour.
struct RawMesh {
  PersonMesh mesh{};
  std::vector<std::string> pictures{};
};

/// The material's picture, packed in the file, or else its plain colour.
std::string picture_of(const aiScene& scene, const aiMaterial& material) {
  aiString name;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) == aiReturn_SUCCESS) {
    const aiTexture* packed = scene.GetEmbeddedTexture(name.C_Str());
    if (packed != nullptr && packed->mHeight == 0) {  // Compressed: mWidth is its size in bytes.
      return {reinterpret_cast<const char*>(packed->pcData), packed->mWidth};
    }
  }
  aiColor3D colour{0.6F, 0.6F, 0.6F};
  material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  return {reinterpret_cast<const char*>(&colour), sizeof colour};
}

Texture texture_of(const std::string& picture) {
  Eigen::Vector3f colour{0.6F, 0.6F, 0.6F};
  if (picture.size() == 3 * sizeof(float)) {
    std::memcpy(colour.data(), picture.data(), picture.size());
  } else if (auto read = Texture::from_png(picture.data(), picture.size())) {
    return std::move(*read);
  }
  return Texture{colour};
}

void append(RawMesh& raw, const aiScene& scene, const aiMesh& mesh) {
  PersonMesh& person = raw.mesh;
  const auto first = static_cast<std::uint32_t>(person.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    person.vertices.push_back({p.x, p.y, p.z});
    person.normals.push_back(vector_of(mesh.mNormals[i]));
    const aiVector3D uv = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][i] : aiVector3D{};
    person.texture_places.emplace_back(uv.x, uv.y);
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices == 3) {
      person.triangles.push_back(
          {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
      person.parts.push_back(static_cast<std::uint32_t>(raw.pictures.size()));
    }
  }
  raw.pictures.push_back(picture_of(scene, *scene.mMaterials[mesh.mMaterialIndex]));
}

/// Reads what `Packer` wrote, and believes no count in it.
class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_{bytes} {}

  template <class List>
  void operator()(List& list) {
    using Item = typename List::value_type;
    std::uint64_t count = 0;
    take(&count, sizeof count);
    is_good_ = is_good_ && count <= (bytes_.size() - at_) / sizeof(Item);
    if (is_good_) {
      list.resize(count);
      take(static_cast<void*>(list.data()), count * sizeof(Item));
    }
  }
  [[nodiscard]] bool is_good() const { return is_good_; }

 private:
  void take(void* to, std::size_t bytes) {
    is_good_ = is_good_ && bytes_.size() - at_ >= bytes;
    if (is_good_ && bytes > 0) {
      std::memcpy(to, bytes_.data() + at_, bytes);
      at_ += bytes;
    }
  }
  const std::string& bytes_;
  std::size_t at_{};
  bool is_good_{true};
};

struct Packer {
  std::string bytes{};
  template <class List>
  void operator()(const List& list) {
    const std::uint64_t count = list.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(list.data()),
                 list.size() * sizeof(typename List::value_type));
  }
};

template <class Mesh, class Pass>
void for_each_list(Mesh& mesh, Pass& pass) {
  pass(mesh.vertices);
  pass(mesh.normals);
  pass(mesh.texture_places);
  pass(mesh.triangles);
  pass(mesh.parts);
}

/// Every index points at something.
bool is_whole(const PersonMesh& mesh) {
  const auto is_vertex = [&](std::uint32_t i) { return i < mesh.vertices.size(); };
  return mesh.normals.size() == mesh.vertices.size() &&
         mesh.texture_places.size() == mesh.vertices.size() &&
         mesh.parts.size() == mesh.triangles.size() &&
         std::all_of(mesh.parts.begin(), mesh.parts.end(),
                     [&](std::uint32_t part) { return part < mesh.textures.size(); }) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& corners) {
           return std::all_of(corners.begin(), corners.end(), is_vertex);
         });
}

std::optional<PersonMesh> unpacked(const std::string& bytes) {
  PersonMesh mesh;
  Unpacker unpack{bytes};
  for_each_list(mesh, unpack);
  std::string one_for_each_picture;
  unpack(one_for_each_picture);
  for (std::size_t i = 0; unpack.is_good() && i < one_for_each_picture.size(); ++i) {
    std::string picture;
    unpack(picture);
    mesh.textures.push_back(texture_of(picture));
  }
  return unpack.is_good() && is_whole(mesh) ? std::optional{std::move(mesh)} : std::nullopt;
}

/// Feet on the ground, above the origin, one metre tall. False for a mesh without height.
bool stand_up(PersonMesh& person) {
  Eigen::AlignedBox3f extent;
  for (const auto& p : person.vertices) {
    extent.extend(Eigen::Vector3f{p[0], p[1], p[2]});
  }
  if (person.vertices.empty() || extent.sizes().z() <= 0.0F) {
    return false;
  }
  const float scale = 1.0F / extent.sizes().z();
  const Eigen::Vector3f foot{extent.center().x(), extent.center().y(), extent.min().z()};
  for (auto& p : person.vertices) {
    p = {scale * (p[0] - foot.x()), scale * (p[1] - foot.y()), scale * (p[2] - foot.z())};
  }
  return true;
}

Error missing(const std::string& file) {
  return {ErrorCode::not_found, "no mesh of a person in \"" + file +
                                    "\"; install the package morse-simulator-data, or set "
                                    "colour_camera.people_folder to where its .blend files are"};
}

/// As bytes: the lists, as many bytes as there are pictures, the pictures.
Result<std::string> packed_mesh(const std::string& file, const Look& look) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(
      file, aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_GenSmoothNormals);
  if (scene == nullptr) {
    return Error{ErrorCode::invalid_input,
                 std::string{"cannot be read: "} + importer.GetErrorString()};
  }
  RawMesh raw;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    if (std::string{mesh.mName.C_Str()}.rfind(look.meshes, 0) == 0) {
      append(raw, *scene, mesh);
    }
  }
  Packer pack;
  for_each_list(raw.mesh, pack);
  pack(std::string(raw.pictures.size(), ' '));
  for (const std::string& picture : raw.pictures) {
    pack(picture);
  }
  return std::move(pack.bytes);
}

}  // namespace

std::vector<std::string> person_looks() {
  std::vector<std::string> names;
  names.reserve(looks.size());
  for (const Look& look : looks) {
    names.emplace_back(look.name);
  }
  return names;
}

void lay_down(PersonMesh& person) {
  float back = 0.0F;
  for (const auto& p : person.vertices) {
    back = std::min(back, p[0]);
  }
  for (auto& p : person.vertices) {
    p = {0.5F - p[2], p[1], p[0] - back};
  }
  for (Eigen::Vector3f& normal : person.normals) {
    normal = {-normal.z(), normal.y(), normal.x()};
  }
}

Result<PersonMesh> load_person_mesh(const std::string& look, const std::string& folder) {
  const Look* wanted = find_look(look);
  if (wanted == nullptr) {
    return Error{ErrorCode::not_found,
                 "no person looks like \"" + look + "\"; there are: walker, victim"};
  }
  const std::string file = folder + "/" + wanted->file;
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) {
    return missing(file);
  }
  const auto bytes = read_in_process(import_limits(std::filesystem::file_size(file, failed)),
                                     [&] { return packed_mesh(file, *wanted); });
  if (!bytes) {
    return Error{ErrorCode::invalid_input,
                 "mesh file of a person \"" + file + "\" " + bytes.error().message};
  }
  auto person = unpacked(*bytes);
  return person && stand_up(*person) ? Result<PersonMesh>{std::move(*person)} : missing(file);
}

}  // namespace flyball
