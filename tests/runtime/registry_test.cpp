// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/registry.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct Fruit {
  virtual ~Fruit() = default;
  [[nodiscard]] virtual std::string taste() const = 0;
};
struct Lemon final : Fruit {
  [[nodiscard]] std::string taste() const override { return "sour"; }
};
struct Fig final : Fruit {
  [[nodiscard]] std::string taste() const override { return "sweet"; }
};
struct Vehicle {
  virtual ~Vehicle() = default;
};
struct LemonCar final : Vehicle {};

Registry example() {
  Registry registry;
  registry.add<Fruit>("lemon", [] { return std::make_unique<Lemon>(); });
  registry.add<Fruit>("fig", [] { return std::make_unique<Fig>(); });
  registry.add<Vehicle>("lemon", [] { return std::make_unique<LemonCar>(); });
  return registry;
}

TEST(Registry, makes_what_was_registered_under_its_interface) {
  const Registry registry = example();
  EXPECT_EQ(registry.make<Fruit>("lemon")->taste(), "sour");
  EXPECT_EQ(registry.make<Fruit>("fig")->taste(), "sweet");
  EXPECT_NE(registry.make<Vehicle>("lemon"), nullptr);
}

TEST(Registry, has_nothing_for_unknown_names_and_interfaces) {
  EXPECT_EQ(example().make<Fruit>("plum"), nullptr);
  EXPECT_EQ(example().make<Vehicle>("fig"), nullptr);
  EXPECT_EQ(Registry{}.make<Fruit>("fig"), nullptr);
}

TEST(Registry, lists_names_in_alphabetical_order) {
  EXPECT_EQ(example().names<Fruit>(), (std::vector<std::string>{"fig", "lemon"}));
  EXPECT_TRUE(Registry{}.names<Fruit>().empty());
}

TEST(Registry, takes_over_what_another_one_has) {
  Registry all = example();
  Registry more;
  EXPECT_TRUE(more.is_empty());
  more.add<Vehicle>("fig", [] { return std::make_unique<LemonCar>(); });
  EXPECT_FALSE(more.is_empty());
  ASSERT_TRUE(all.merge(std::move(more)).ok());
  EXPECT_NE(all.make<Vehicle>("fig"), nullptr);
  EXPECT_NE(all.make<Vehicle>("lemon"), nullptr);
}

TEST(Registry, takes_over_nothing_when_a_name_is_taken) {
  Registry all = example();
  Registry more;
  more.add<Fruit>("apple", [] { return std::make_unique<Fig>(); });
  more.add<Fruit>("lemon", [] { return std::make_unique<Fig>(); });
  const Status merged = all.merge(std::move(more));
  ASSERT_FALSE(merged.ok());
  EXPECT_EQ(merged.error().message, "\"lemon\" is taken; give yours another name");
  EXPECT_EQ(all.names<Fruit>(), (std::vector<std::string>{"fig", "lemon"}));
  EXPECT_EQ(all.make<Fruit>("lemon")->taste(), "sour");
}

TEST(RegistryDeathTest, a_name_cannot_be_taken_twice) {
  Registry registry = example();
  EXPECT_DEATH(registry.add<Fruit>("fig", [] { return std::make_unique<Fig>(); }),
               "\"fig\" is registered twice");
}

}  // namespace
}  // namespace flyball
