// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/recorder.h"

#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::string hash_of(const std::vector<Field>& row, int at_ns = 5, const char* channel = "state") {
  MemoryRecorder recorder;
  recorder.record(MissionTime{Duration{at_ns}}, channel, row);
  return recorder.hash().hex();
}

TEST(TraceHash, is_fnv_1a) {
  TraceHash hash;
  EXPECT_EQ(hash.hex(), "cbf29ce484222325");
  hash.add(std::uint64_t{0});
  // eight times (h ^ 0) * prime, from the published offset basis
  std::uint64_t expected = 0xcbf29ce484222325ULL;
  for (int i = 0; i < 8; ++i) {
    expected *= 0x100000001b3ULL;
  }
  EXPECT_EQ(hash.value(), expected);
}

TEST(TraceHash, counts_names_types_values_and_order) {
  const std::set<std::string> hashes{
      hash_of({{"a", 1.0}, {"b", 2.0}}),
      hash_of({{"b", 2.0}, {"a", 1.0}}),
      hash_of({{"a", 1.0}, {"c", 2.0}}),
      hash_of({{"a", 1.0}, {"b", std::nextafter(2.0, 3.0)}}),
      hash_of({{"a", 1.0}, {"b", std::int64_t{2}}}),
      hash_of({{"a", 1.0}, {"b", std::string{"2"}}}),
      hash_of({{"a", 1.0}}),
      hash_of({{"a", 1.0}, {"b", 2.0}}, 6),
      hash_of({{"a", 1.0}, {"b", 2.0}}, 5, "other"),
  };
  EXPECT_EQ(hashes.size(), 9U);
  EXPECT_EQ(hash_of({{"a", 1.0}, {"b", 2.0}}), hash_of({{"a", 1.0}, {"b", 2.0}}));
}

TEST(TraceHash, does_not_run_texts_together) {
  EXPECT_NE(hash_of({{"ab", std::string{"c"}}}), hash_of({{"a", std::string{"bc"}}}));
}

TEST(TraceHash, ignores_signs_that_mean_nothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hash_of({{"a", -0.0}}), hash_of({{"a", 0.0}}));
  EXPECT_EQ(hash_of({{"a", nan}}), hash_of({{"a", -nan}}));
  EXPECT_NE(hash_of({{"a", nan}}), hash_of({{"a", 0.0}}));
}

TEST(MemoryRecorder, keeps_all_rows_in_order) {
  MemoryRecorder recorder;
  recorder.record(MissionTime{Duration{1}}, "state", {{"z_m", 1.5}});
  recorder.record(MissionTime{Duration{2}}, "event", {{"what", std::string{"landed"}}});
  ASSERT_EQ(recorder.rows().size(), 2U);
  EXPECT_EQ(recorder.rows()[0].channel, "state");
  EXPECT_EQ(std::get<double>(recorder.rows()[0].fields[0].value), 1.5);
  EXPECT_EQ(recorder.rows()[1].at, MissionTime{Duration{2}});
  EXPECT_EQ(std::get<std::string>(recorder.rows()[1].fields[0].value), "landed");
}

TEST(MemoryRecorder, that_is_full_says_so_and_goes_on_hashing) {
  MemoryRecorder small{10'000};
  MemoryRecorder usual;
  std::size_t kept = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Field> row{{"text", std::string(100, 'x')}, {"i", static_cast<double>(i)}};
    small.record(MissionTime{Duration{i}}, "state", row);
    usual.record(MissionTime{Duration{i}}, "state", row);
    kept = i == 99 ? small.rows().size() : kept;
  }
  ASSERT_TRUE(small.is_full());
  EXPECT_FALSE(usual.is_full());
  EXPECT_EQ(kept, small.rows().size()) << "no more is kept";
  EXPECT_LT(small.rows().size(), 100U);
  EXPECT_EQ("event", small.rows().back().channel);
  EXPECT_NE(std::string::npos,
            std::get<std::string>(small.rows().back().fields[0].value).find("the record is full"));
  EXPECT_EQ(usual.hash().value(), small.hash().value());
}

}  // namespace
}  // namespace flyball
