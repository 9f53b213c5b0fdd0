// SPDX-License-Identifier: BSD-3-Clause
#include "people/person_mesh.h"

#include "flyball/sim/person.h"

#include <algorithm>
#include <cctype>
#include <exception>

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

/// The material's picture, packed in the file, or else its plain colour.
Texture texture_of(const aiScene& scene, const aiMaterial& material) {
  aiString name;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) == aiReturn_SUCCESS) {
    const aiTexture* packed = scene.GetEmbeddedTexture(name.C_Str());
    if (packed != nullptr && packed->mHeight == 0) {  // Compressed: mWidth is its size in bytes.
      if (auto picture = Texture::from_png(packed->pcData, packed->mWidth)) {
        return std::move(*picture);
      }
    }
  }
  aiColor3D colour{0.6F, 0.6F, 0.6F};
  material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  return Texture{Eigen::Vector3f{colour.r, colour.g, colour.b}};
}

void append(PersonMesh& person, const aiScene& scene, const aiMesh& mesh) {
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
      person.parts.push_back(static_cast<std::uint32_t>(person.textures.size()));
    }
  }
  person.textures.push_back(texture_of(scene, *scene.mMaterials[mesh.mMaterialIndex]));
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

}  // namespace

std::vector<std::string> person_looks() {
  std::vector<std::string> names;
  for (const Look& look : looks) {
    names.emplace_back(look.name);
  }
  return names;
}

Result<PersonMesh> load_person_mesh(const std::string& look, const std::string& folder) {
  const Look* wanted = find_look(look);
  if (wanted == nullptr) {
    return Error{ErrorCode::not_found,
                 "no person looks like \"" + look + "\"; there are: walker, victim"};
  }
  const std::string file = folder + "/" + wanted->file;
  try {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(
        file, aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_GenSmoothNormals);
    if (scene == nullptr) {
      return missing(file);
    }
    PersonMesh person;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene->mMeshes[i];
      if (std::string{mesh.mName.C_Str()}.rfind(wanted->meshes, 0) == 0) {
        append(person, *scene, mesh);
      }
    }
    return stand_up(person) ? Result<PersonMesh>{std::move(person)} : missing(file);
  } catch (const std::exception&) {
    return missing(file);
  }
}

}  // namespace flyball
