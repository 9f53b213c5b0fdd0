// flyball-package: octomap
// flyball-link: octomap octomath
// SPDX-License-Identifier: BSD-3-Clause
//
// The map in bricks. Either one lattice whose resolution is a level (bricks/lattice_mapper.h), or,
// as stock OctoMap has it, cells for each resolution that was used (layered_mapper.h): then flights
// are those with mapper octomap, and the host answers faster.

#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"

#include "bricks/brick_store.h"
#include "bricks/lattice_mapper.h"
#include "scans/ray_scan.h"
#include <algorithm>

namespace {

using flyball::Error;
using flyball::ErrorCode;
using flyball::Result;
using flyball::Status;
using flyball::Vec3;

class FlyballMapper final : public flyball::Mapper {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    auto specs = flyball::make_lattice_mapper()->parameters();
    specs.push_back({"layers",
                     "one",
                     0.0,
                     0.0,
                     "one: coarse cells are freed when seen through as a whole; stock: every "
                     "resolution has its own cells, freed by any ray, front-end exact",
                     {"one", "stock"}});
    return specs;
  }

  Status configure(const flyball::Parameters& chosen,
                   const flyball::FindModel& find_model) override {
    if (chosen.text("layers") != "stock") {
      map_ = flyball::make_lattice_mapper();
      return map_->configure(chosen, find_model);
    }
    for (const char* limit : {"most_traversals", "keep_radius_m"}) {
      if (chosen.number(limit) > 0.0) {
        return Error{ErrorCode::invalid_input, std::string{"layers = \"stock\" knows no "} + limit +
                                                   "; leave it out, or set layers to \"one\""};
      }
    }
    map_ = std::make_unique<flyball::LayeredMapper<flyball::BrickStore>>();
    return flyball::Done{};
  }

  [[nodiscard]] std::vector<double> resolutions_m() const override { return map_->resolutions_m(); }
  [[nodiscard]] double longest_range_m(double resolution_m) const override {
    return map_->longest_range_m(resolution_m);
  }
  /// One lattice of cells refuses longer rays than so many of its finest ones.
  [[nodiscard]] std::vector<flyball::KnobSpec> knobs() const override {
    auto all = Mapper::knobs();
    for (flyball::KnobSpec& spec : all) {
      if (spec.name == "map.range_m" && !resolutions_m().empty()) {
        spec.max =
            std::min(spec.max, flyball::RayScan::most_cells_per_ray * resolutions_m().front());
        spec.fallback = std::min(spec.fallback, spec.max);
      }
    }
    return all;
  }

  Result<flyball::Work> prepare(const flyball::PointCloud& cloud_C,
                                const flyball::Pose& X_WC,
                                const flyball::MapperSettings& settings) override {
    return map_->prepare(cloud_C, X_WC, settings);
  }
  Result<flyball::Work> prepare_frame(const flyball::PointCloudFrame& frame,
                                      const flyball::Pose& X_WC,
                                      const flyball::MapperSettings& settings) override {
    return map_->prepare_frame(frame, X_WC, settings);
  }
  void commit() override { map_->commit(); }

  void declare_clear(const Vec3& centre_W, const flyball::Cylinder& space) override {
    map_->declare_clear(centre_W, space);
  }
  void doubt_obstacles(const Vec3& p_W, double radius_m) override {
    map_->doubt_obstacles(p_W, radius_m);
  }
  [[nodiscard]] const flyball::OccupancyView& view() const override { return map_->view(); }
  [[nodiscard]] std::shared_ptr<const flyball::OccupancyView> revision() override {
    return map_->revision();
  }
  [[nodiscard]] std::vector<flyball::OccupiedCell> occupied() const override {
    return map_->occupied();
  }
  [[nodiscard]] flyball::MapContents contents() const override { return map_->contents(); }
  [[nodiscard]] Status write(const std::string& path,
                             std::optional<double> resolution_m) const override {
    return map_->write(path, resolution_m);
  }
  [[nodiscard]] Status keep_forgotten(const std::string& path) override {
    return map_->keep_forgotten(path);
  }
  [[nodiscard]] Status read(const std::string& path) override { return map_->read(path); }

 private:
  std::unique_ptr<flyball::Mapper> map_{flyball::make_lattice_mapper()};
};

}  // namespace

FLYBALL_PLUGIN(flyball) {
  registry.add<flyball::Mapper>("flyball", [] { return std::make_unique<FlyballMapper>(); });
}
