// SPDX-License-Identifier: BSD-3-Clause
#include "world/solid_surface.h"

#include "world/import_process.h"
#include "world/missing_file.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include <assimp/Importer.hpp>
#include <assimp/commonMetaData.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace flyball {
namespace {

using Index = ScanGrid::Index;
using Triangle = std::array<Vec3, 3>;

// Twenty times the largest grid; a test of one cell takes 5 to 10 ns.
constexpr double most_cells_around = 20.0 * most_grid_cells;

Error unreadable(const std::string& path, const std::string& why) {
  return {ErrorCode::invalid_input, "mesh file \"" + path + "\" " + why};
}

/// What Assimp says of a file, as one line of printable characters.
std::string reason_of(const Assimp::Importer& importer) {
  std::string reason = importer.GetErrorString();
  std::replace_if(
      reason.begin(), reason.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, ' ');
  return reason.empty() ? "it holds no triangles" : reason;
}

using Corners = std::array<aiVector3D, 3>;

/// Points and lines of the file are left out.
void append(std::string& bytes, const aiMesh& mesh) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    const auto is_vertex = [&](unsigned index) { return index < mesh.mNumVertices; };
    if (face.mNumIndices == 3 && std::all_of(face.mIndices, face.mIndices + 3, is_vertex)) {
      for (int k = 0; k < 3; ++k) {
        bytes.append(reinterpret_cast<const char*>(&mesh.mVertices[face.mIndices[k]]),
                     sizeof(aiVector3D));
      }
    }
  }
}

/// Whether y points up in what Assimp hands over. It has turned COLLADA's scenes from the axis that
/// they name to y already.
bool y_is_up(const aiScene& scene, UpAxis asked) {
  aiString format;
  if (scene.mMetaData != nullptr) {
    scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format);
  }
  const std::string name = format.C_Str();  // "Collada Importer", "glTF2 Importer", ...
  const bool is_gltf = name.rfind("glTF", 0) == 0;
  return name.rfind("Collada", 0) == 0 || asked == UpAxis::y || (asked == UpAxis::file && is_gltf);
}

/// 'y' or 'z' for the axis that points up, then the corners of all triangles, one after the other,
/// as they lie in memory.
Result<std::string> read_corners(const std::string& path, UpAxis up) {
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  std::string bytes{scene != nullptr && y_is_up(*scene, up) ? 'y' : 'z'};
  for (unsigned i = 0; scene != nullptr && i < scene->mNumMeshes; ++i) {
    append(bytes, *scene->mMeshes[i]);
  }
  if (bytes.size() == 1) {
    return Error{ErrorCode::invalid_input,
                 "has no triangles that Assimp can read: " + reason_of(importer)};
  }
  return bytes;
}

Vec3 placed(const aiVector3D& v, double metres_per_unit, bool y_is_up) {
  const Vec3 p = metres_per_unit * Vec3{v.x, v.y, v.z};
  return y_is_up ? Vec3{p.x(), -p.z(), p.y()} : p;
}

Result<std::vector<Triangle>> read_triangles(const std::string& path, const MeshReading& reading) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed) || !std::ifstream{path}) {
    return missing_file("mesh file", path);
  }
  const auto bytes =
      read_in_process(import_limits(std::filesystem::file_size(path, failed), reading.processor_s),
                      [&] { return read_corners(path, reading.up); });
  if (!bytes) {
    return Error{bytes.error().code, "mesh file \"" + path + "\" " + bytes.error().message};
  }
  const bool y_is_up = bytes->front() == 'y';
  std::vector<Triangle> triangles;
  for (std::size_t at = 1; at + sizeof(Corners) <= bytes->size(); at += sizeof(Corners)) {
    Corners corners;
    std::memcpy(corners.data(), bytes->data() + at, sizeof corners);
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      triangle[k] = placed(corners[k], reading.metres_per_unit, y_is_up);
      if (!triangle[k].allFinite()) {
        return unreadable(path, "has a triangle whose corner is not finite");
      }
    }
  }
  return triangles;
}

Aabb extent_of(const std::vector<Triangle>& triangles) {
  Aabb extent{triangles.front()[0], triangles.front()[0]};
  for (const Triangle& triangle : triangles) {
    for (const Vec3& p : triangle) {
      extent.min = extent.min.cwiseMin(p);
      extent.max = extent.max.cwiseMax(p);
    }
  }
  return extent;
}

Index cell_at(const Vec3& p, double cell_m) {
  return (p / cell_m).array().floor().cast<int>();
}

/// `mark` tests so many cells in all.
double cells_around(const std::vector<Triangle>& triangles, double cell_m) {
  double cells = 0.0;
  for (const Triangle& triangle : triangles) {
    const Aabb around = extent_of({triangle});
    cells += ((around.max - around.min) / cell_m + Vec3::Ones()).prod();
  }
  return cells;
}

void mark(ScanGrid& grid, const Triangle& triangle) {
  const double cell_m = grid.resolution_m();
  const Aabb around = extent_of({triangle});
  const Index low = cell_at(around.min, cell_m).cwiseMax(grid.low());
  const Index high = cell_at(around.max, cell_m).cwiseMin(grid.high());
  const auto mark_cell = [&](const Index& cell) {
    const Vec3 corner = cell_m * Vec3{cell.cast<double>()};
    if (touches(triangle, {corner, corner + Vec3::Constant(cell_m)})) {
      grid.set(cell, CellState::occupied);
    }
  };
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        mark_cell({x, y, z});
      }
    }
  }
}

}  // namespace

UpAxis up_axis(const std::string& name) {
  return name == "y" ? UpAxis::y : name == "z" ? UpAxis::z : UpAxis::file;
}

bool touches(const Triangle& triangle, const Aabb& box) {
  const Vec3 centre = 0.5 * (box.min + box.max);
  const Vec3 half = 0.5 * (box.max - box.min);
  const Triangle p{triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const auto is_apart = [&](const Vec3& axis) {
    const double reach = half.dot(axis.cwiseAbs());
    const double a = p[0].dot(axis);
    const double b = p[1].dot(axis);
    const double c = p[2].dot(axis);
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  const std::array<Vec3, 3> edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  if (is_apart(edges[0].cross(edges[1]))) {
    return false;
  }
  for (int k = 0; k < 3; ++k) {
    const Vec3 unit = Vec3::Unit(k);
    const bool apart =
        is_apart(unit) || std::any_of(edges.begin(), edges.end(),
                                      [&](const Vec3& e) { return is_apart(e.cross(unit)); });
    if (apart) {
      return false;
    }
  }
  return true;
}

Result<ScanGrid> read_mesh(const std::string& path, const MeshReading& reading) {
  const auto triangles = read_triangles(path, reading);
  if (!triangles) {
    return triangles.error();
  }
  const Aabb extent = extent_of(*triangles);
  const Vec3 cells = (extent.max - extent.min) / reading.cell_m + Vec3::Ones();
  const double farthest_m =
      std::max(extent.min.cwiseAbs().maxCoeff(), extent.max.cwiseAbs().maxCoeff());
  constexpr int most_along = std::numeric_limits<int>::max() / 2;
  if (!(cells.prod() <= most_grid_cells) || !(farthest_m / reading.cell_m < most_along)) {
    return unreadable(path,
                      "has an extent of more than 2e8 cells; set a larger cell_m, or a "
                      "metres_per_unit that fits the file");
  }
  if (cells_around(*triangles, reading.cell_m) > most_cells_around) {
    return unreadable(path,
                      "has too many large triangles for cells this small; set a larger cell_m");
  }
  ScanGrid grid{reading.cell_m, cell_at(extent.min, reading.cell_m),
                cell_at(extent.max, reading.cell_m)};
  for (const Triangle& triangle : *triangles) {
    mark(grid, triangle);
  }
  return grid;
}

}  // namespace flyball
