// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/message_pool.h"

#include <array>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(MessagePool, gives_out_again_what_it_was_given_back) {
  MessagePool pool;
  void* first = pool.take(100);
  pool.give_back(first, 100);
  void* again = pool.take(128);  // Of the same size of block.
  EXPECT_EQ(again, first);
  void* other = pool.take(129);
  EXPECT_NE(other, first);
  pool.give_back(again, 128);
  pool.give_back(other, 129);
}

TEST(MessagePool, blocks_that_are_out_are_different) {
  MessagePool pool;
  std::set<void*> blocks;
  for (int i = 0; i < 100; ++i) {
    blocks.insert(pool.take(60));
  }
  EXPECT_EQ(blocks.size(), 100U);
  for (void* block : blocks) {
    pool.give_back(block, 60);
  }
}

TEST(MessagePool, a_message_may_outlive_whoever_made_the_pool) {
  auto pool = std::make_shared<MessagePool>();
  const std::weak_ptr<MessagePool> alive = pool;
  auto message = make_message(pool, std::array<int, 1000>{7});
  auto small = make_message(pool, 5);
  pool.reset();
  EXPECT_EQ((*message)[0], 7);
  EXPECT_EQ(*small, 5);
  message.reset();
  EXPECT_FALSE(alive.expired());
  small.reset();
  EXPECT_TRUE(alive.expired());
}

TEST(MessagePool, destroys_what_a_message_holds) {
  const auto pool = std::make_shared<MessagePool>();
  const auto held = std::make_shared<int>(1);
  auto message = make_message(pool, std::vector<std::shared_ptr<int>>{held, held});
  EXPECT_EQ(held.use_count(), 3);
  message.reset();
  EXPECT_EQ(held.use_count(), 1);
}

TEST(MessagePool, serves_several_threads) {
  const auto pool = std::make_shared<MessagePool>();
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&pool, t] {
      for (int i = 0; i < 2000; ++i) {
        const auto a = make_message(pool, std::array<int, 20>{t});
        const auto b = make_message(pool, std::array<int, 20>{i});
        EXPECT_EQ((*a)[0], t);
        EXPECT_EQ((*b)[0], i);
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

}  // namespace
}  // namespace flyball
