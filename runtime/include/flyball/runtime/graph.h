// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A workload as nodes that talk by typed topics and services; the same graph for every executor.

#include "flyball/runtime/assert.h"
#include "flyball/runtime/numbers.h"
#include "flyball/runtime/realtime/message_pool.h"
#include "flyball/runtime/time.h"
#include "flyball/runtime/work.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <variant>
#include <vector>

namespace flyball {

/// Whether T tells its numbers.
template <class T, class = void>
inline constexpr bool tells_numbers = false;
template <class T>
inline constexpr bool tells_numbers<
    T,
    std::void_t<decltype(visit_numbers(std::declval<T&>(), std::declval<NumberVisitor&>()))>> =
    true;

/// Handle of a topic that carries T.
template <class T>
struct Topic {
  int index{-1};
};

/// A request topic and its response topic.
template <class Request, class Response>
struct Service {
  Topic<Request> request;
  Topic<Response> response;
};

/// Owners: the topic's slots, and every job that reads the message while it runs.
using Message = std::shared_ptr<const void>;

struct TopicSpec {
  std::string name;
  std::type_index type;
  std::size_t capacity{1};  ///< 1: latest value. More: a queue; the oldest is dropped and counted.
  double (*wire_bytes)(const void* message){};  ///< Of one message on a link to another computer.
  /// Makes a copy and shows its numbers to the visitor, who may change them; null where the type of
  /// the messages does not tell them.
  Message (*with_numbers)(const void* message, NumberVisitor& visitor){};
};

/// How many bytes a message takes on a link: `wire_bytes` of its type, where the type's header
/// declares one, else its size in memory.
template <class T>
auto bytes_on_wire(const T& message, int /*preferred*/) -> decltype(wire_bytes(message)) {
  return wire_bytes(message);
}
template <class T>
double bytes_on_wire(const T& /*message*/, long /*otherwise*/) {
  return static_cast<double>(sizeof(T));
}

enum class OnMiss : std::uint8_t {
  warn,   ///< Count it.
  skip,   ///< Tell the job to stop; its outputs never appear.
  brake,  ///< Stop the vehicle: whoever runs the executor must, in `Executor::on_miss`.
};

/// A job starts when a message arrives on `topic`, ...
struct OnMessage {
  int topic{};
};
/// ... or every `period`, first after `phase`.
struct OnPeriod {
  Duration period{};
  Duration phase{};
};

struct NodeSpec {
  std::string name;
  /// Kernel name on the platform's price list, unless a job's work says another one
  /// (`Work::charged_as`). Empty: takes no time.
  std::string cost;
  std::variant<OnMessage, OnPeriod> trigger{OnPeriod{}};
  int priority{};       ///< Higher runs first.
  Duration deadline{};  ///< From release to end; zero: none.
  OnMiss on_miss{OnMiss::warn};
  /// Under `skip`, how long a job that was told to stop goes on at most: the longest time between
  /// two questions of its body (`JobContext::should_stop`). A modeled computer works so long on it.
  Duration stop_latency{};
  /// Cores that the job can use at once; every shipped kernel uses one, but for explorers. The
  /// modeled computer gives it at most so many, or as many threads as have shared its work
  /// (`Work::threads`), and `Platform::speedup` says what they bring to the part of the work that
  /// they share (`Work::add_shared`).
  int threads{1};
  /// Topics besides the trigger. A job that touches one that is not declared is a broken
  /// precondition: the printed graph tells the truth. Each node reads a queue at its own pace.
  std::vector<int> reads{};
  std::vector<int> writes{};
};

/// What a job may touch. Its publications appear when the job's time has passed.
class JobContext {
 public:
  /// @param pool  Where its publications take their memory; null: the heap.
  explicit JobContext(std::shared_ptr<MessagePool> pool = nullptr) : pool_{std::move(pool)} {}
  JobContext(const JobContext&) = delete;
  JobContext& operator=(const JobContext&) = delete;
  virtual ~JobContext() = default;

  [[nodiscard]] virtual MissionTime now() const = 0;
  /// When the trigger fired.
  [[nodiscard]] virtual MissionTime released() const = 0;
  /// Newest message; null if none has been published.
  template <class T>
  [[nodiscard]] std::shared_ptr<const T> latest(Topic<T> topic) const {
    return std::static_pointer_cast<const T>(read(topic.index));
  }
  /// Oldest unread message of a queue, which is removed; null when empty. For a latest-value topic
  /// the value is returned once.
  template <class T>
  [[nodiscard]] std::shared_ptr<const T> take(Topic<T> topic) {
    return std::static_pointer_cast<const T>(pop(topic.index));
  }
  template <class T>
  void publish(Topic<T> topic, T value) {
    push(topic.index, make_message(pool_, std::move(value)));
  }
  /// A long computation asks now and then, and returns early when it is true: the job's deadline
  /// has passed under `OnMiss::skip`, or the executor stops, so that nobody will see its outputs.
  [[nodiscard]] virtual bool should_stop() const { return false; }
  /// Runs when the job ends, before its publications appear; never when it was killed.
  virtual void at_end(std::function<void(MissionTime)> action) = 0;

 protected:
  [[nodiscard]] virtual Message read(int topic) const = 0;
  [[nodiscard]] virtual Message pop(int topic) = 0;
  virtual void push(int topic, Message message) = 0;

 private:
  std::shared_ptr<MessagePool> pool_;  ///< Owners: see `PoolAllocator`.
};

/// The node's computation; returns the work that it did.
using Body = std::function<Work(JobContext&)>;

struct Node {
  NodeSpec spec;
  Body body;
};

class Graph {
 public:
  explicit Graph(std::string name) : name_{std::move(name)} {}

  /// @pre `name` is new, `capacity >= 1`.
  template <class T>
  Topic<T> topic(std::string name, std::size_t capacity = 1) {
    const auto wire_bytes = [](const void* message) {
      return bytes_on_wire(*static_cast<const T*>(message), 0);
    };
    return {add_topic({std::move(name), typeid(T), capacity, wire_bytes, with_numbers_of<T>()})};
  }
  template <class Request, class Response>
  Service<Request, Response> service(const std::string& name, std::size_t capacity = 4) {
    return {topic<Request>(name + ".request", capacity),
            topic<Response>(name + ".response", capacity)};
  }
  /// The topic of this name that carries T; empty when there is none.
  template <class T>
  [[nodiscard]] std::optional<Topic<T>> find(const std::string& name) const {
    const int index = find_topic(name, typeid(T));
    return index >= 0 ? std::optional{Topic<T>{index}} : std::nullopt;
  }
  /// @pre `spec.name` is new; its topics exist; `threads >= 1`.
  void node(NodeSpec spec, Body body);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<TopicSpec>& topics() const { return topics_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] std::string to_text() const;
  [[nodiscard]] std::string to_dot() const;

 private:
  /// What `TopicSpec::with_numbers` does; null for a type that does not tell its numbers.
  template <class T>
  static constexpr auto with_numbers_of() -> Message (*)(const void*, NumberVisitor&) {
    if constexpr (tells_numbers<T>) {
      return [](const void* message, NumberVisitor& visitor) -> Message {
        auto copy = std::make_shared<T>(*static_cast<const T*>(message));
        visit_numbers(*copy, visitor);
        return copy;
      };
    } else {
      return nullptr;
    }
  }
  int add_topic(TopicSpec spec);
  /// -1: there is none.
  [[nodiscard]] int find_topic(const std::string& name, std::type_index type) const;
  std::string name_;
  std::vector<TopicSpec> topics_;
  std::vector<Node> nodes_;
};

}  // namespace flyball
