// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Decodes protobuf by nothing but its documentation and the descriptors that stand in a file:
/// written against protobuf.dev, not against the code under test.

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// One field as it stands in the bytes.
struct WireField {
  int number{};
  int kind{};  ///< 0: number, 1: 8 bytes, 2: sized, 5: 4 bytes.
  std::uint64_t value{};
  std::string_view bytes{};
};

/// Throws std::out_of_range where the bytes are no protobuf message.
inline std::vector<WireField> wire_fields(std::string_view bytes) {
  const auto take = [&bytes](std::size_t size) {
    if (size > bytes.size()) {
      throw std::out_of_range{"a field that does not end"};
    }
    const std::string_view part = bytes.substr(0, size);
    bytes.remove_prefix(size);
    return part;
  };
  const auto number = [&take] {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(take(1).front());
      value |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
      if (byte < 0x80U) {
        return value;
      }
    }
  };
  std::vector<WireField> all;
  while (!bytes.empty()) {
    const std::uint64_t key = number();
    WireField field{static_cast<int>(key >> 3U), static_cast<int>(key & 7U), 0, {}};
    if (field.kind == 0) {
      field.value = number();
    } else if (field.kind == 2) {
      field.bytes = take(number());
    } else if (field.kind == 1 || field.kind == 5) {
      field.bytes = take(field.kind == 1 ? 8 : 4);
      std::memcpy(&field.value, field.bytes.data(), field.bytes.size());
    } else {
      throw std::out_of_range{"a kind that is none"};
    }
    all.push_back(field);
  }
  return all;
}

/// A message with the names of its fields.
struct DecodedMessage {
  std::map<std::string, std::vector<double>> numbers{};  ///< Of enums and bools too.
  std::map<std::string, std::vector<std::string>> texts{};
  std::map<std::string, std::vector<DecodedMessage>> messages{};

  [[nodiscard]] double number(const std::string& field) const { return numbers.at(field).at(0); }
  [[nodiscard]] const std::string& text(const std::string& field) const {
    return texts.at(field).at(0);
  }
  [[nodiscard]] const DecodedMessage& message(const std::string& field) const {
    return messages.at(field).at(0);
  }
};

/// Decodes by a FileDescriptorSet; throws std::out_of_range for a field that is not declared, that
/// is of another type, or that comes twice without being a list.
class ProtobufDecoder {
 public:
  explicit ProtobufDecoder(std::string_view descriptor_set) {
    for (const WireField& file : wire_fields(descriptor_set)) {
      add_file(file.bytes);
    }
  }
  [[nodiscard]] DecodedMessage decode(const std::string& type, std::string_view bytes) const {
    DecodedMessage message;
    std::map<int, int> seen;
    for (const WireField& wire : wire_fields(bytes)) {
      const Field& field = types_.at("." + type).at(wire.number);
      if (wire.kind != kind_of(field.type) || (++seen[wire.number] > 1 && !field.is_list)) {
        throw std::out_of_range{type + "." + field.name + ": not as it is declared"};
      }
      if (field.type == 11) {
        message.messages[field.name].push_back(decode(field.type_name.substr(1), wire.bytes));
      } else if (wire.kind == 2) {
        message.texts[field.name].emplace_back(wire.bytes);
      } else {
        double value = static_cast<double>(wire.value);
        if (field.type == 3 || field.type == 5) {
          value = static_cast<double>(static_cast<std::int64_t>(wire.value));
        } else if (field.type == 1) {
          std::memcpy(&value, wire.bytes.data(), sizeof value);
        }
        message.numbers[field.name].push_back(value);
      }
    }
    return message;
  }

 private:
  struct Field {
    std::string name{};
    std::uint64_t type{};
    std::string type_name{};
    bool is_list{};
  };

  static int kind_of(std::uint64_t type) {
    switch (type) {
      case 1:
        return 1;
      case 7:
        return 5;
      case 9:
      case 11:
      case 12:
        return 2;
      default:
        return 0;
    }
  }
  void add_file(std::string_view file) {
    std::string package;
    for (const WireField& one : wire_fields(file)) {
      if (one.number == 2) {
        package = one.bytes;
      } else if (one.number == 3 && files_.count(std::string{one.bytes}) == 0) {
        throw std::out_of_range{"a file that is used before it stands there"};
      }
    }
    for (const WireField& one : wire_fields(file)) {
      if (one.number == 1) {
        files_[std::string{one.bytes}] = true;
      } else if (one.number == 4) {
        add_message("." + package, one.bytes);
      }
    }
  }
  void add_message(const std::string& scope, std::string_view message) {
    std::string name;
    std::map<int, Field> fields;
    for (const WireField& one : wire_fields(message)) {
      if (one.number == 1) {
        name = one.bytes;
      } else if (one.number == 2) {
        Field field;
        int number = 0;
        for (const WireField& part : wire_fields(one.bytes)) {
          field.name = part.number == 1 ? std::string{part.bytes} : field.name;
          number = part.number == 3 ? static_cast<int>(part.value) : number;
          field.is_list = part.number == 4 ? part.value == 3 : field.is_list;
          field.type = part.number == 5 ? part.value : field.type;
          field.type_name = part.number == 6 ? std::string{part.bytes} : field.type_name;
        }
        fields[number] = field;
      }
    }
    types_[scope + "." + name] = fields;
  }
  std::map<std::string, bool> files_{};
  std::map<std::string, std::map<int, Field>> types_{};
};
