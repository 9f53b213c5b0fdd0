// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/message_schema.h"

#include "flyball/mcap/protobuf.h"
#include "flyball/runtime/assert.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

/// Numbers of the fields, as descriptor.proto has them.
namespace set {
constexpr int file = 1;
}
namespace file {
constexpr int name = 1;
constexpr int package = 2;
constexpr int dependency = 3;
constexpr int message = 4;
constexpr int syntax = 12;
}  // namespace file
namespace message {
constexpr int name = 1;
constexpr int field = 2;
constexpr int choice = 4;
}  // namespace message
namespace field {
constexpr int name = 1;
constexpr int number = 3;
constexpr int label = 4;
constexpr int type = 5;
constexpr int type_name = 6;
}  // namespace field
namespace choice {
constexpr int name = 1;
constexpr int value = 2;
}  // namespace choice
namespace value {
constexpr int name = 1;
constexpr int number = 2;
}  // namespace value

constexpr std::uint64_t label_optional = 1;
constexpr std::uint64_t label_repeated = 3;

/// `foxglove.Pose` as `foxglove` and `Pose`.
std::pair<std::string, std::string> package_and_name(const std::string& full) {
  const std::size_t dot = full.rfind('.');
  FLYBALL_ASSERT(dot != std::string::npos, "a message without a package: %s", full.c_str());
  return {full.substr(0, dot), full.substr(dot + 1)};
}

std::string file_of(std::string full) {
  if (full == "google.protobuf.Timestamp") {
    return "google/protobuf/timestamp.proto";  // Readers know it by this name.
  }
  std::replace(full.begin(), full.end(), '.', '/');
  return full + ".proto";
}

const MessageSchema& named(const std::vector<MessageSchema>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const MessageSchema& one) { return one.name == name; });
  FLYBALL_ASSERT(found != all.end(), "no message %s", name.c_str());
  return *found;
}

Protobuf field_descriptor(const SchemaField& one, int number, const std::string& owner) {
  Protobuf out;
  out.text(field::name, one.name)
      .number(field::number, static_cast<std::uint64_t>(number))
      .number(field::label, one.is_list ? label_repeated : label_optional)
      .number(field::type, static_cast<std::uint64_t>(one.type));
  if (one.type == FieldType::message) {
    out.text(field::type_name, "." + one.of);
  } else if (one.type == FieldType::choice) {
    out.text(field::type_name, "." + owner + "." + one.of);
  }
  return out;
}

Protobuf choice_descriptor(const SchemaChoice& one) {
  Protobuf out;
  out.text(choice::name, one.name);
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    out.message(choice::value,
                Protobuf{}.text(value::name, one.values[i]).number(value::number, i));
  }
  return out;
}

Protobuf message_descriptor(const MessageSchema& schema) {
  Protobuf out;
  out.text(message::name, package_and_name(schema.name).second);
  int number = 0;
  for (const SchemaField& one : schema.fields) {
    out.message(message::field, field_descriptor(one, ++number, schema.name));
  }
  for (const SchemaChoice& one : schema.choices) {
    out.message(message::choice, choice_descriptor(one));
  }
  return out;
}

Protobuf file_descriptor(const MessageSchema& schema, const std::vector<std::string>& uses) {
  Protobuf out;
  out.text(file::name, file_of(schema.name));
  out.text(file::package, package_and_name(schema.name).first);
  for (const std::string& one : uses) {
    out.text(file::dependency, file_of(one));
  }
  return out.message(file::message, message_descriptor(schema)).text(file::syntax, "proto3");
}

/// Adds the file of a message behind those of what it consists of.
void add_file(const std::vector<MessageSchema>& all,
              const std::string& name,
              std::vector<std::string>& added,
              Protobuf& out) {
  if (std::find(added.begin(), added.end(), name) != added.end()) {
    return;
  }
  const MessageSchema& schema = named(all, name);
  std::vector<std::string> uses;
  for (const SchemaField& one : schema.fields) {
    if (one.type == FieldType::message &&
        std::find(uses.begin(), uses.end(), one.of) == uses.end()) {
      uses.push_back(one.of);
    }
  }
  for (const std::string& used : uses) {
    add_file(all, used, added, out);
  }
  added.push_back(name);
  out.message(set::file, file_descriptor(schema, uses));
}

}  // namespace

std::string descriptor_set(const std::vector<MessageSchema>& all, const std::string& name) {
  std::vector<std::string> added;
  Protobuf out;
  add_file(all, name, added, out);
  return out.bytes();
}

}  // namespace flyball
