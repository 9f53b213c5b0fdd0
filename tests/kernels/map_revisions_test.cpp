// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
//
// Revisions of maps, of all mappers: a reader keeps the map that it began with. With the preset
// tsan the last test shows that it needs no lock for that.
#include "flyball/kernels/mapper.h"

#include "made_mapper.h"
#include "map_answers.h"
#include "scratch_folder.h"
#include "synthetic_scans.h"
#include <atomic>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 7.0;
constexpr int rounds = 8;  // of questions

struct Kind {
  std::string name;
  std::string mapper;
  std::map<std::string, ParameterValue> parameters;
  std::vector<double> resolutions_m;
};

const std::vector<Kind> kinds{
    {"octomap", "octomap", {}, {0.15, 0.30, 0.60, 0.80}},
    {"stock", "flyball", {{"layers", std::string{"stock"}}}, {0.15, 0.30, 0.60, 0.80}},
    {"pyramid", "flyball", {}, {0.15, 0.30, 0.60, 1.20}},
    {"exact", "flyball", {{"front_end", std::string{"exact"}}}, {0.15, 0.30}},
    {"forgetting", "flyball", {{"keep_radius_m", 2.0}}, {0.15, 0.60}},
};

class MapRevisions : public testing::TestWithParam<Kind> {
 protected:
  /// A frame at a random place and resolution, and at times declared space.
  void change(Mapper& mapper) {
    const auto& sizes_m = GetParam().resolutions_m;
    const auto place = pick(2) == 0 ? kit::Place::indoor : kit::Place::outdoor;
    const int frame = pick(40);
    const auto scan = kit::synthetic_scan(place, frame, range_m, 48);
    const double resolution_m =
        sizes_m[static_cast<std::size_t>(pick(static_cast<int>(sizes_m.size())))];
    ASSERT_TRUE(mapper.prepare(scan.cloud_C, scan.X_WC, {resolution_m, range_m}).ok());
    mapper.commit();
    if (pick(3) == 0) {
      mapper.declare_clear(scan.X_WC.translation(), {0.4, 0.3});
    }
  }
  int pick(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  std::unique_ptr<Mapper> mapper_{kit::made_mapper(GetParam().mapper, GetParam().parameters)};

 private:
  std::mt19937 random_{11};
};

struct Kept {
  std::shared_ptr<const OccupancyView> revision;
  kit::MapAnswers answers;
};

TEST_P(MapRevisions, keep_every_answer_while_the_map_changes) {
  std::vector<Kept> kept;
  int changes = 0;
  for (int round = 0; round < 12; ++round) {
    const kit::MapAnswers now{mapper_->view(), 3, rounds};
    kept.push_back({mapper_->revision(), now});
    change(*mapper_);
    changes += kit::MapAnswers{mapper_->view(), 3, rounds} != now ? 1 : 0;
    if (kept.size() > 4) {  // Readers come and go, and not in turn.
      kept.erase(kept.begin() + pick(4));
    }
    for (const Kept& one : kept) {
      ASSERT_EQ((kit::MapAnswers{*one.revision, 3, rounds}), one.answers) << round;
    }
  }
  EXPECT_GT(changes, 6);
}

TEST_P(MapRevisions, show_what_the_view_shows_when_they_are_made) {
  for (int round = 0; round < 10; ++round) {
    const auto revision = mapper_->revision();
    const auto seed = static_cast<unsigned>(round);
    EXPECT_EQ((kit::MapAnswers{*revision, seed, 3 * rounds}),
              (kit::MapAnswers{mapper_->view(), seed, 3 * rounds}));
    const auto again = mapper_->revision();
    EXPECT_EQ((kit::MapAnswers{*again, seed, rounds}), (kit::MapAnswers{*revision, seed, rounds}));
    change(*mapper_);
  }
}

TEST_P(MapRevisions, outlive_a_map_that_is_read_from_a_file_and_the_mapper) {
  const ScratchFolder folder;
  const std::string path = folder.path("map.bt");
  for (int round = 0; round < 4; ++round) {
    change(*mapper_);
  }
  const double written_m = mapper_->contents().levels.front().cell_m;
  ASSERT_TRUE(mapper_->write(path, written_m).ok());
  change(*mapper_);
  const Kept before{mapper_->revision(), kit::MapAnswers{mapper_->view(), 5, rounds}};
  ASSERT_TRUE(mapper_->read(path).ok());
  const Kept read{mapper_->revision(), kit::MapAnswers{mapper_->view(), 5, rounds}};
  EXPECT_NE(before.answers, read.answers);
  const auto scan = kit::synthetic_scan(kit::Place::outdoor, 3, range_m, 48);
  ASSERT_TRUE(mapper_->prepare(scan.cloud_C, scan.X_WC, {written_m, range_m}).ok());
  mapper_->commit();
  mapper_ = nullptr;
  EXPECT_EQ((kit::MapAnswers{*before.revision, 5, rounds}), before.answers);
  EXPECT_EQ((kit::MapAnswers{*read.revision, 5, rounds}), read.answers);
}

TEST_P(MapRevisions, take_a_bounded_amount_of_memory) {
  const auto flight_bytes = [this](std::size_t readers) {
    const auto mapper = kit::made_mapper(GetParam().mapper, GetParam().parameters);
    std::vector<std::shared_ptr<const OccupancyView>> held(readers);
    std::size_t most = 0;
    for (int frame = 0; frame < 24; ++frame) {
      kit::insert_scan(*mapper, kit::Place::indoor, frame % 8, 0.15, range_m);
      if (readers > 0) {
        held[static_cast<std::size_t>(frame) % readers] = mapper->revision();
      }
      if (frame % 8 == 7) {  // Counting cells takes long.
        most = std::max(most, mapper->contents().bytes);
      }
    }
    return most;
  };
  // Each reader can hold all that questions look at, which is at most as much as the rest.
  const std::size_t alone = flight_bytes(0);
  EXPECT_GT(flight_bytes(1), alone);
  EXPECT_LT(flight_bytes(1), 3 * alone);
  EXPECT_LT(flight_bytes(3), 5 * alone);
}

TEST_P(MapRevisions, are_read_by_two_threads_while_a_third_one_writes) {
  std::mutex mutex;
  std::shared_ptr<const Kept> newest;
  std::atomic<bool> is_done{false};
  std::atomic<int> differences{0};
  std::atomic<int> comparisons{0};
  const auto publish = [&] {
    auto kept = std::make_shared<const Kept>(
        Kept{mapper_->revision(), kit::MapAnswers{mapper_->view(), 7, rounds}});
    const std::lock_guard<std::mutex> lock{mutex};
    newest = std::move(kept);
  };
  const auto read = [&] {
    for (bool is_last = false; !is_last;) {
      is_last = is_done;
      std::shared_ptr<const Kept> mine;
      {
        const std::lock_guard<std::mutex> lock{mutex};
        mine = newest;
      }
      for (int again = 0; again < 2; ++again) {
        differences += kit::MapAnswers{*mine->revision, 7, rounds} != mine->answers ? 1 : 0;
        ++comparisons;
      }
    }
  };
  publish();
  std::thread one{read};
  std::thread other{read};
  for (int frame = 0; frame < 15; ++frame) {
    change(*mapper_);
    publish();
  }
  is_done = true;
  one.join();
  other.join();
  EXPECT_EQ(differences, 0);
  EXPECT_GE(comparisons, 4);
}

INSTANTIATE_TEST_SUITE_P(Mappers, MapRevisions, testing::ValuesIn(kinds), [](const auto& kind) {
  return kind.param.name;
});

}  // namespace
}  // namespace flyball
