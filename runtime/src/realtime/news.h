// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the jobs' threads have to tell the owner's thread.

#include "flyball/runtime/executor.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace flyball {

struct News {
  enum class Kind { message, job, miss, stuck };
  Kind kind{};
  int index{};  ///< Topic of a message, node of the others.
  Message message{};
  JobRecord record{};  ///< Of a job.
  Duration running{};  ///< Of a job that is stuck.
};

/// A list that keeps its memory, and that of the records in it, when it is emptied.
class NewsList {
 public:
  [[nodiscard]] News& add(News::Kind kind, int index) {
    if (used_ == slots_.size()) {
      slots_.emplace_back();
    }
    News& slot = slots_[used_++];
    slot.kind = kind;
    slot.index = index;
    return slot;
  }
  void clear() {
    for (std::size_t i = 0; i < used_; ++i) {
      slots_[i].message.reset();
    }
    used_ = 0;
  }
  [[nodiscard]] std::size_t size() const { return used_; }
  [[nodiscard]] const News& operator[](std::size_t i) const { return slots_[i]; }
  void swap(NewsList& other) {
    slots_.swap(other.slots_);
    std::swap(used_, other.used_);
  }

 private:
  std::vector<News> slots_{};
  std::size_t used_{};
};

}  // namespace flyball
