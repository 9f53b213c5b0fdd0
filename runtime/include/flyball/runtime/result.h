// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A value, or one sentence that says why there is none.

#include "flyball/runtime/assert.h"

#include <string>
#include <utility>
#include <variant>

namespace flyball {

enum class ErrorCode { invalid_input, not_found, failed, unavailable };

/// `message` names the thing, the value and the way out.
struct Error {
  ErrorCode code{ErrorCode::failed};
  std::string message;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_{std::move(value)} {}      // NOLINT: returning a value should read so
  Result(Error error) : content_{std::move(error)} {}  // NOLINT

  [[nodiscard]] bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }

  /// @pre `ok()`.
  [[nodiscard]] T& value() {
    check();
    return std::get<T>(content_);
  }
  [[nodiscard]] const T& value() const {
    check();
    return std::get<T>(content_);
  }
  [[nodiscard]] T& operator*() { return value(); }
  [[nodiscard]] const T& operator*() const { return value(); }
  [[nodiscard]] T* operator->() { return &value(); }
  [[nodiscard]] const T* operator->() const { return &value(); }

  /// @pre `!ok()`.
  [[nodiscard]] const Error& error() const { return std::get<Error>(content_); }

 private:
  void check() const { FLYBALL_ASSERT(ok(), "no value: %s", error().message.c_str()); }
  std::variant<T, Error> content_;
};

/// Success without a value: `return Done{};`
struct Done {};
using Status = Result<Done>;

}  // namespace flyball
