// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/picture_thread.h"

#include "flyball/runtime/realtime/cpus.h"

#include <utility>

namespace flyball {

PictureThread::PictureThread() {
  thread_ = std::thread{[this] { run(); }};
}

PictureThread::~PictureThread() {
  {
    const std::lock_guard lock{mutex_};
    is_ending_ = true;
  }
  news_.notify_one();
  thread_.join();
}

void PictureThread::draw(TakenPicture picture) {
  {
    const std::lock_guard lock{mutex_};
    next_ = std::move(picture);
  }
  news_.notify_one();
}

std::vector<TakenPicture> PictureThread::take_ready() {
  const std::lock_guard lock{mutex_};
  return std::exchange(ready_, {});
}

void PictureThread::run() {
  step_back();
  std::unique_lock lock{mutex_};
  for (;;) {
    news_.wait(lock, [this] { return is_ending_ || next_; });
    if (is_ending_) {
      return;
    }
    const TakenPicture picture = *std::exchange(next_, std::nullopt);
    lock.unlock();
    (void)picture.colour.image.value();
    lock.lock();
    ready_.push_back(picture);
  }
}

}  // namespace flyball
