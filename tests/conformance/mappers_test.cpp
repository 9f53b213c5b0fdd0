// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/mapper_conformance.h"

#include "kernel_trials.h"
#include "made_mapper.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// An honest view whose answers are spoilt.
class SpoiltView final : public OccupancyView {
 public:
  SpoiltView(const OccupancyView& honest, const std::string& crime)
      : honest_{honest}, crime_{crime} {}

  [[nodiscard]] double resolution_m() const override { return honest_.resolution_m(); }
  [[nodiscard]] CellState state(const Vec3& p_W) const override {
    const CellState state = honest_.state(p_W);
    if ((crime_ == "optimist" && state == CellState::unknown) ||
        (crime_ == "blind" && state == CellState::occupied)) {
      return CellState::free;
    }
    if ((crime_ == "pessimist" && state == CellState::free) ||
        (crime_ == "prophet" && state == CellState::unknown)) {
      return crime_ == "prophet" ? CellState::occupied : CellState::unknown;
    }
    return state;
  }
  [[nodiscard]] CellState body_state(const Vec3& p_WB, const Cylinder& body) const override {
    return crime_ == "bodiless" ? honest_.state(p_WB) : honest_.body_state(p_WB, body);
  }
  [[nodiscard]] bool has_occupied(const Aabb& box) const override {
    return crime_ == "boxless" ? false : honest_.has_occupied(box);
  }
  [[nodiscard]] bool segment_hits(const Vec3& from,
                                  const Vec3& to,
                                  const Cylinder& body) const override {
    return crime_ == "sampling" ? honest_.body_state(from, body) == CellState::occupied ||
                                      honest_.body_state(to, body) == CellState::occupied
                                : honest_.segment_hits(from, to, body);
  }
  [[nodiscard]] double obstacle_density(const Vec3& p_W,
                                        double radius_m,
                                        double half_band_m) const override {
    return honest_.obstacle_density(p_W, radius_m, half_band_m);
  }
  [[nodiscard]] double nearest_obstacle_m(const Vec3& p_W,
                                          double limit_m,
                                          double half_band_m) const override {
    return honest_.nearest_obstacle_m(p_W, limit_m, half_band_m);
  }

 private:
  const OccupancyView& honest_;
  const std::string& crime_;
};

class MapperCulprit final : public Mapper {
 public:
  explicit MapperCulprit(std::string crime) : crime_{std::move(crime)} {
    if (crime_ == "sulking") {
      honest_ = kit::made_mapper("flyball");  // The other one ignores doubts.
    }
  }

  Result<Work> prepare(const PointCloud& cloud_C,
                       const Pose& X_WC,
                       const MapperSettings& settings) override {
    MapperSettings asked = settings;
    if (crime_ == "far_sighted") {
      asked.range_m *= 1.5;
    } else if (crime_ == "forgetful" && settings.resolution_m != last_m_ && last_m_ > 0.0) {
      honest_ = kit::kernels().make<Mapper>("octomap");
    } else if (crime_ == "credulous" && !(settings.resolution_m > 0.0)) {
      return Work{};
    }
    last_m_ = settings.resolution_m;
    if (crime_ == "keeps_both") {
      honest_->commit();
    }
    auto work = honest_->prepare(cloud_C, X_WC, asked);
    if (crime_ == "hasty") {
      honest_->commit();
    }
    return work ? spoilt(*work) : work;
  }
  Result<Work> prepare_frame(const PointCloudFrame& frame,
                             const Pose& X_WC,
                             const MapperSettings& settings) override {
    PointCloud cloud = frame.cloud_C.value();
    if (crime_ == "careless") {
      cloud.hits_C.clear();
    }
    return prepare(cloud, X_WC, settings);
  }
  void commit() override {
    if (crime_ != "deaf" && !does_not_learn_) {
      honest_->commit();
    }
  }
  void declare_clear(const Vec3& centre_W, const Cylinder& space) override {
    if (crime_ != "stubborn") {
      honest_->declare_clear(centre_W, space);
    }
  }
  void doubt_obstacles(const Vec3& p_W, double radius_m) override {
    honest_->doubt_obstacles(p_W, radius_m);
    does_not_learn_ = crime_ == "sulking";
    if (crime_ == "rash") {
      honest_ = kit::kernels().make<Mapper>("octomap");
    }
  }
  [[nodiscard]] const OccupancyView& view() const override {
    spoilt_ = std::make_unique<SpoiltView>(honest_->view(), crime_);
    return *spoilt_;
  }
  [[nodiscard]] std::shared_ptr<const OccupancyView> revision() override {
    // A shared pointer to what goes on changing.
    return crime_ == "aliasing" ? std::shared_ptr<const OccupancyView>{honest_, &honest_->view()}
                                : honest_->revision();
  }
  [[nodiscard]] std::vector<OccupiedCell> occupied() const override {
    auto cells = honest_->occupied();
    if (crime_ == "invents") {
      cells.push_back({{-0.5, 0.0, 1.4}, 0.15});
    }
    return cells;
  }

 private:
  [[nodiscard]] Work spoilt(const Work& honest) const {
    Work work;
    for (const WorkItem& item : honest.items()) {
      work.add(item.name, crime_ == "idle"        ? 0.0
                          : crime_ == "shrinking" ? 1e6 / (1.0 + item.count)
                                                  : item.count);
    }
    static double missions = 0.0;
    if (crime_ == "remembers") {
      work.add("rays", 1e-3 * ++missions);
    }
    return work;
  }

  std::string crime_;
  std::shared_ptr<Mapper> honest_{kit::kernels().make<Mapper>("octomap")};  // With "aliasing".
  mutable std::unique_ptr<SpoiltView> spoilt_{};
  double last_m_{};
  bool does_not_learn_{};
};

TEST(Mappers, keep_their_contract) {
  kit::try_all_registered<MapperConformance, Mapper>();
}

TEST(Mappers, keep_their_contract_in_other_configurations) {
  using Given = std::map<std::string, ParameterValue>;
  for (const Given& given :
       {Given{{"layers", std::string{"stock"}}}, Given{{"front_end", std::string{"exact"}}},
        Given{{"front_end", std::string{"rays"}}}, Given{{"finest_m", 0.1}},
        Given{{"cost_of", std::string{"octomap"}}}}) {
    MapperConformance conformance{{[] { return kit::kernels().make<Mapper>("flyball"); }, given}};
    for (const std::string& breach : conformance.breaches()) {
      ADD_FAILURE() << given.begin()->first << ": " << breach;
    }
  }
}

TEST(MapperConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<MapperConformance, Mapper>(
      [](const std::string& crime) { return std::make_unique<MapperCulprit>(crime); },
      {{"optimist", "claims to know what no ray came near"},
       {"blind", "does not mark what every frame has hit"},
       {"pessimist", "does not free what every frame has seen through"},
       {"prophet", "marks an obstacle where nothing was hit"},
       {"bodiless", "calls a body's room better than its cells are"},
       {"boxless", "misses an occupied cell in a box"},
       {"sampling", "misses a cell that a segment hits"},
       {"far_sighted", "marks an obstacle where nothing was hit"},
       {"forgetful", "forgets obstacles when the resolution changes"},
       {"credulous", "accepts a resolution or a range that is not positive"},
       {"keeps_both", "commits a scan that another one has replaced"},
       {"hasty", "changes its view before the scan is committed"},
       {"careless", "makes another map of a frame than of its points"},
       {"deaf", "does not mark what every frame has hit"},
       {"stubborn", "does not free unknown space that is declared clear"},
       {"rash", "frees an obstacle that is in doubt, or forgets more than obstacles"},
       {"sulking", "does not learn again what was in doubt"},
       {"aliasing", "changes a revision that it has handed on"},
       {"invents", "lists a cell as occupied that its view does not call so"},
       {"idle", "counts no rays or no updates"},
       {"shrinking", "counts less work for a larger input"},
       {"remembers", "begins a mission with what another one has mapped"}});
}

}  // namespace
}  // namespace flyball
