// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a protobuf message consists of, as a table and as readers of MCAP files want it.

#include <cstdint>
#include <string>
#include <vector>

namespace flyball {

/// With the numbers of protobuf's `FieldDescriptorProto.Type`.
enum class FieldType : std::uint8_t {
  real = 1,      ///< `double`
  int64 = 3,     ///< `int64`
  uint64 = 4,    ///< `uint64`
  int32 = 5,     ///< `int32`
  fixed32 = 7,   ///< `fixed32`
  flag = 8,      ///< `bool`
  text = 9,      ///< `string`
  message = 11,  ///< Another message.
  bytes = 12,    ///< `bytes`
  choice = 14,   ///< An enum of the message.
};

/// The first field has number 1, and so on.
struct SchemaField {
  std::string name{};
  FieldType type{};
  std::string of{};  ///< Of `message` its full name, of `choice` the enum's.
  bool is_list{};
};

/// An enum inside a message; the first value is 0, and so on.
struct SchemaChoice {
  std::string name{};
  std::vector<std::string> values{};
};

struct MessageSchema {
  std::string name{};  ///< With its package: `foxglove.Pose`.
  std::vector<SchemaField> fields{};
  std::vector<SchemaChoice> choices{};
};

/// A serialized `google.protobuf.FileDescriptorSet` (descriptor.proto in protobuf's repository) of
/// the message `name` and all messages that it consists of, each in a file of its own, used ones
/// first.
/// @pre `all` has these messages, and none of them contains itself.
[[nodiscard]] std::string descriptor_set(const std::vector<MessageSchema>& all,
                                         const std::string& name);

}  // namespace flyball
