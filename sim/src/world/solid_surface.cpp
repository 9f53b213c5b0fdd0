// SPDX-License-Identifier: BSD-3-Clause
#include "world/solid_surface.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <limits>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace flyball {
namespace {

using Index = ScanGrid::Index;
using Triangle = std::array<Vec3, 3>;

Error unreadable(const std::string& path, const std::string& why) {
  return {ErrorCode::invalid_input, "mesh file \"" + path + "\" " + why};
}

Vec3 placed(const aiVector3D& v, const MeshReading& reading) {
  const Vec3 p = reading.metres_per_unit * Vec3{v.x, v.y, v.z};
  return reading.y_is_up ? Vec3{p.x(), -p.z(), p.y()} : p;
}

void append(std::vector<Triangle>& triangles, const aiMesh& mesh, const MeshReading& reading) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices == 3) {
      const auto corner = [&](int k) { return placed(mesh.mVertices[face.mIndices[k]], reading); };
      triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }
}

/// Points and lines of the file are left out.
Result<std::vector<Triangle>> read_triangles(const std::string& path, const MeshReading& reading) {
  if (!std::ifstream{path}) {
    return Error{ErrorCode::not_found, "no mesh file \"" + path + "\""};
  }
  try {
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
    std::vector<Triangle> triangles;
    for (unsigned i = 0; scene != nullptr && i < scene->mNumMeshes; ++i) {
      append(triangles, *scene->mMeshes[i], reading);
    }
    if (triangles.empty()) {
      return unreadable(path, "has no triangles that Assimp can read");
    }
    return triangles;
  } catch (const std::exception&) {
    return unreadable(path, "is damaged");
  }
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

void mark(ScanGrid& grid, const Triangle& triangle) {
  const double cell_m = grid.resolution_m();
  const Aabb around = extent_of({triangle});
  const Index low = cell_at(around.min, cell_m).cwiseMax(grid.low());
  const Index high = cell_at(around.max, cell_m).cwiseMin(grid.high());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const Vec3 corner = cell_m * Vec3{Index{x, y, z}.cast<double>()};
        if (touches(triangle, {corner, corner + Vec3::Constant(cell_m)})) {
          grid.set({x, y, z}, CellState::occupied);
        }
      }
    }
  }
}

}  // namespace

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
  if (!(cells.prod() <= most_grid_cells) ||
      !(farthest_m / reading.cell_m < std::numeric_limits<int>::max() / 2)) {
    return unreadable(path,
                      "has an extent of more than 2e8 cells; set a larger cell_m, or a "
                      "metres_per_unit that fits the file");
  }
  ScanGrid grid{reading.cell_m, cell_at(extent.min, reading.cell_m),
                cell_at(extent.max, reading.cell_m)};
  for (const Triangle& triangle : *triangles) {
    mark(grid, triangle);
  }
  return grid;
}

}  // namespace flyball
