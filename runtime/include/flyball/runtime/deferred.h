// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Values that are computed only if somebody looks.

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace flyball {

/// A value that the first look computes, and that stays. Copies share it, so a message can carry
/// what is dear to compute and often overtaken unread. For pure computations only: when, and
/// whether, they run must not change a result.
template <class T>
class Deferred {
 public:
  Deferred() : Deferred{[] { return T{}; }} {}
  /// @param compute  Called at most once, from whichever thread looks first; released afterwards.
  ///                 What it refers to lives until then.
  explicit Deferred(std::function<T()> compute) : shared_{std::make_shared<Shared>()} {
    shared_->compute = std::move(compute);
  }
  /// A value that exists already.
  static Deferred of(T value) {
    Deferred deferred;
    deferred.shared_->value = std::move(value);
    std::call_once(deferred.shared_->once, [] {});
    return deferred;
  }

  /// The same at every call. Threads that look meanwhile wait for the first one.
  [[nodiscard]] const T& value() const {
    std::call_once(shared_->once, [this] {
      shared_->value = shared_->compute();
      shared_->compute = nullptr;
    });
    return shared_->value;
  }

 private:
  struct Shared {
    std::once_flag once;
    std::function<T()> compute;
    T value{};
  };
  std::shared_ptr<Shared> shared_;  ///< Owners: all copies.
};

}  // namespace flyball
