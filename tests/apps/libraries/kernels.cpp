// SPDX-License-Identifier: BSD-3-Clause
//
// Libraries of kernels, each with something about it; LIBRARY is its name.

#include "flyball/kernels/detector.h"
#include "flyball/runtime/registry.h"

#include <stdexcept>

#define ENTRY(library) FLYBALL_PLUGIN(library)

namespace {
class Blind final : public flyball::Detector {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override { return {}; }
  flyball::Status configure(const flyball::Parameters&, const flyball::FindModel&) override {
    return flyball::Done{};
  }
  flyball::Result<std::vector<flyball::Detection>> detect(const flyball::ColourImage&,
                                                          double,
                                                          flyball::Work&) override {
    return std::vector<flyball::Detection>{};
  }
};
}  // namespace

ENTRY(LIBRARY) {
#ifdef THROWS
  throw std::runtime_error{"nothing works"};
#endif
#ifdef ADDS
  registry.add<flyball::Detector>(ADDS, [] { return std::make_unique<Blind>(); });
#endif
}
