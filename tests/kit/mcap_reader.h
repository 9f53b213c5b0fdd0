// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Reads an MCAP file twice, from its front and by its index, and holds the two against each other:
/// written against https://mcap.dev/spec, with zlib's CRC, not against the code under test.

#include "protobuf_decoder.h"
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <zlib.h>
#include <zstd.h>

class McapReader {
 public:
  struct Channel {
    std::string topic{};
    std::string schema{};
  };
  struct Message {
    std::string topic{};
    std::uint32_t sequence{};
    std::uint64_t at_ns{};
    std::string bytes{};
    bool operator==(const Message& other) const {
      return std::tie(topic, sequence, at_ns, bytes) ==
             std::tie(other.topic, other.sequence, other.at_ns, other.bytes);
    }
  };
  struct Chunk {
    std::uint64_t begin{};  ///< Where it stands in the file.
    std::uint64_t end{};
    std::uint64_t begin_ns{};
    std::uint64_t end_ns{};
    std::vector<Message> messages{};
  };

  explicit McapReader(const std::string& path) {
    std::ifstream in{path, std::ios::binary};
    file_.assign(std::istreambuf_iterator<char>{in}, {});
    read_data();
    if (faults.empty()) {
      read_summary();
    }
  }

  std::vector<std::string> faults{};  ///< Everything that is not as the specification has it.
  std::map<std::uint16_t, Channel> channels{};
  std::map<std::string, std::string> descriptors{};  ///< By schema.
  std::vector<Chunk> chunks{};
  std::map<std::string, std::map<std::string, std::string>> metadata{};

  [[nodiscard]] std::vector<Message> messages(const std::string& topic = "") const {
    std::vector<Message> all;
    for (const Chunk& chunk : chunks) {
      for (const Message& one : chunk.messages) {
        if (topic.empty() || one.topic == topic) {
          all.push_back(one);
        }
      }
    }
    return all;
  }
  /// Every message of the topic, by the descriptors in the file; throws when one cannot be decoded.
  [[nodiscard]] std::vector<DecodedMessage> decoded(const std::string& topic) const {
    std::vector<DecodedMessage> all;
    for (const auto& [id, channel] : channels) {
      if (channel.topic == topic) {
        const ProtobufDecoder decoder{descriptors.at(channel.schema)};
        for (const Message& one : messages(topic)) {
          all.push_back(decoder.decode(channel.schema, one.bytes));
        }
      }
    }
    return all;
  }

 private:
  class Cursor {
   public:
    Cursor(std::string_view bytes, std::vector<std::string>& faults)
        : bytes_{bytes}, faults_{faults} {}
    template <class T>
    T number() {
      T value{};
      const std::string_view part = take(sizeof value);
      std::memcpy(&value, part.data(), part.size());
      return value;
    }
    std::string_view take(std::uint64_t size) {
      if (size > bytes_.size()) {
        faults_.emplace_back("something ends too early");
        bytes_ = {};
        return {};
      }
      const std::string_view part = bytes_.substr(0, size);
      bytes_.remove_prefix(size);
      return part;
    }
    std::string text() { return std::string{take(number<std::uint32_t>())}; }
    [[nodiscard]] std::string_view rest() const { return bytes_; }

   private:
    std::string_view bytes_;
    std::vector<std::string>& faults_;
  };
  struct Record {
    int opcode{};
    std::uint64_t begin{};
    std::string_view content{};
    [[nodiscard]] std::uint64_t end() const { return begin + 9 + content.size(); }
  };

  void require(bool holds, const std::string& what) {
    if (!holds) {
      faults.push_back(what);
    }
  }
  [[nodiscard]] std::uint32_t crc_of(std::uint64_t begin, std::uint64_t end) const {
    return crc_of(std::string_view{file_}.substr(begin, end - begin));
  }
  [[nodiscard]] static std::uint32_t crc_of(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
  }
  Record record_at(std::uint64_t place) {
    Cursor in{std::string_view{file_}.substr(std::min<std::uint64_t>(place, file_.size())), faults};
    const auto opcode = in.number<std::uint8_t>();
    const auto size = in.number<std::uint64_t>();
    return {opcode, place, in.take(size)};
  }

  void read_data() {
    const std::string magic{"\x89MCAP0\r\n", 8};
    if (file_.size() < 16 || file_.substr(0, 8) != magic ||
        file_.substr(file_.size() - 8) != magic) {
      faults.emplace_back("no magic at both ends");
      return;
    }
    for (std::uint64_t place = 8; faults.empty();) {
      const Record record = record_at(place);
      require(place != 8 || record.opcode == 1, "no header first");
      place = record.end();
      Cursor in{record.content, faults};
      if (record.opcode == 3 || record.opcode == 4) {
        describe(record);
      } else if (record.opcode == 6) {
        read_chunk(record);
      } else if (record.opcode == 7) {
        message_indexes_[record.begin] = record.content;
      } else if (record.opcode == 0x0c) {
        metadata_places_[record.begin] = record.end();
        const std::string name = in.text();
        metadata[name] = texts(in.text());
      } else if (record.opcode == 0x0f) {
        require(in.number<std::uint32_t>() == crc_of(0, record.begin), "wrong CRC of the data");
        summary_begin_ = record.end();
        return;
      }
    }
  }
  std::map<std::string, std::string> texts(const std::string& bytes) {
    std::map<std::string, std::string> all;
    for (Cursor in{bytes, faults}; !in.rest().empty();) {
      const std::string key = in.text();
      all[key] = in.text();
    }
    return all;
  }
  void describe(const Record& record) {
    Cursor in{record.content, faults};
    const auto id = in.number<std::uint16_t>();
    if (record.opcode == 3) {
      schemas_[id] = in.text();
      require(in.text() == "protobuf", "a schema that is no protobuf");
      descriptors[schemas_[id]] = in.text();
    } else {
      const auto schema = in.number<std::uint16_t>();
      channels[id] = {in.text(), schemas_.at(schema)};
      require(in.text() == "protobuf", "a channel that is no protobuf");
    }
  }
  void read_chunk(const Record& record) {
    Cursor in{record.content, faults};
    Chunk chunk;
    chunk.begin = record.begin;
    chunk.end = record.end();
    chunk.begin_ns = in.number<std::uint64_t>();
    chunk.end_ns = in.number<std::uint64_t>();
    std::string records(in.number<std::uint64_t>(), '\0');
    const auto crc = in.number<std::uint32_t>();
    require(in.text() == "zstd", "a chunk that is not compressed by zstd");
    const std::string_view compressed = in.take(in.number<std::uint64_t>());
    require(in.rest().empty(), "something behind a chunk's records");
    require(ZSTD_decompress(records.data(), records.size(), compressed.data(), compressed.size()) ==
                records.size(),
            "a chunk of another size than it says");
    require(crc_of(records) == crc, "wrong CRC of a chunk");
    read_messages(records, chunk);
    chunks.push_back(std::move(chunk));
  }
  void read_messages(const std::string& records, Chunk& chunk) {
    std::uint64_t first = UINT64_MAX;
    std::uint64_t last = 0;
    Cursor in{records, faults};
    while (!in.rest().empty() && faults.empty()) {
      const std::uint64_t offset = records.size() - in.rest().size();
      require(in.number<std::uint8_t>() == 5, "something in a chunk that is no message");
      Cursor message{in.take(in.number<std::uint64_t>()), faults};
      const auto channel = message.number<std::uint16_t>();
      Message one;
      one.topic = channels.at(channel).topic;
      one.sequence = message.number<std::uint32_t>();
      one.at_ns = message.number<std::uint64_t>();
      require(message.number<std::uint64_t>() == one.at_ns, "published at another time");
      one.bytes = message.rest();
      first = std::min(first, one.at_ns);
      last = std::max(last, one.at_ns);
      entries_[{chunk.begin, channel}].emplace_back(one.at_ns, offset);
      chunk.messages.push_back(std::move(one));
    }
    require(first == chunk.begin_ns && last == chunk.end_ns, "a chunk of other times than it says");
  }

  void read_summary() {
    const Record footer = record_at(file_.size() - 8 - 9 - 20);
    Cursor in{footer.content, faults};
    require(footer.opcode == 2 && footer.content.size() == 20, "no footer");
    require(in.number<std::uint64_t>() == summary_begin_, "the footer points elsewhere");
    const auto offsets_begin = in.number<std::uint64_t>();
    require(in.number<std::uint32_t>() == crc_of(summary_begin_, file_.size() - 8 - 4),
            "wrong CRC of the summary");
    std::map<int, std::pair<std::uint64_t, std::uint64_t>> groups;
    std::uint64_t place = summary_begin_;
    while (place < footer.begin && faults.empty()) {
      const Record record = record_at(place);
      if (record.opcode == 0x0e) {
        require(place >= offsets_begin, "an offset among the groups");
        Cursor group{record.content, faults};
        const int opcode = group.number<std::uint8_t>();
        const auto begin = group.number<std::uint64_t>();
        require(groups[opcode] == std::pair{begin, begin + group.number<std::uint64_t>()},
                "an offset of another group");
      } else {
        require(place < offsets_begin, "a group behind the offsets");
        auto& [begin, end] = groups.emplace(record.opcode, std::pair{place, place}).first->second;
        require(end == place, "a group in two pieces");
        end = record.end();
        read_summary_record(record);
      }
      place = record.end();
    }
    require(indexed_chunks_ == chunks.size(), "a chunk without an index");
    require(indexed_metadata_ == metadata_places_.size(), "metadata without an index");
    require(described_ == channels.size() + schemas_.size(),
            "a channel that is not in the summary");
  }
  void read_summary_record(const Record& record) {
    Cursor in{record.content, faults};
    if (record.opcode == 3 || record.opcode == 4) {
      ++described_;
    } else if (record.opcode == 8) {
      check_chunk_index(in);
    } else if (record.opcode == 0x0b) {
      check_statistics(in);
    } else if (record.opcode == 0x0d) {
      const auto begin = in.number<std::uint64_t>();
      require(metadata_places_.at(begin) == begin + in.number<std::uint64_t>() &&
                  metadata.count(in.text()) == 1,
              "an index of other metadata");
      ++indexed_metadata_;
    } else {
      faults.push_back("in the summary, a record " + std::to_string(record.opcode));
    }
  }
  void check_chunk_index(Cursor& in) {
    const Chunk& chunk = chunks.at(indexed_chunks_++);
    require(in.number<std::uint64_t>() == chunk.begin_ns, "an index of other times");
    require(in.number<std::uint64_t>() == chunk.end_ns, "an index of other times");
    require(in.number<std::uint64_t>() == chunk.begin, "an index of another chunk");
    require(in.number<std::uint64_t>() == chunk.end - chunk.begin, "an index of another length");
    const std::string offsets = in.text();
    const auto index_bytes = in.number<std::uint64_t>();
    require(in.text() == "zstd", "an index of another compression");
    std::uint64_t place = chunk.end;
    for (Cursor each{offsets, faults}; !each.rest().empty();) {
      const auto channel = each.number<std::uint16_t>();
      require(each.number<std::uint64_t>() == place, "a message index that stands elsewhere");
      check_message_index(place, chunk, channel);
      place += 9 + message_indexes_.at(place).size();
    }
    require(place - chunk.end == index_bytes, "message indexes of another length");
    require(entries_.lower_bound({chunk.begin, 0}) == entries_.end() ||
                entries_.lower_bound({chunk.begin, 0})->first.first != chunk.begin,
            "messages without an index");
  }
  void check_message_index(std::uint64_t place, const Chunk& chunk, std::uint16_t channel) {
    Cursor in{message_indexes_.at(place), faults};
    require(in.number<std::uint16_t>() == channel, "a message index of another channel");
    const std::string entries = in.text();
    std::vector<std::pair<std::uint64_t, std::uint64_t>> found;
    for (Cursor each{entries, faults}; !each.rest().empty();) {
      const auto at_ns = each.number<std::uint64_t>();
      found.emplace_back(at_ns, each.number<std::uint64_t>());
    }
    require(found == entries_[{chunk.begin, channel}], "a message index of other messages");
    entries_.erase({chunk.begin, channel});
  }
  void check_statistics(Cursor& in) {
    const std::vector<Message> all = messages();
    std::map<std::string, std::uint64_t> counts;
    for (const Message& one : all) {
      ++counts[one.topic];
    }
    require(in.number<std::uint64_t>() == all.size(), "statistics: messages");
    require(in.number<std::uint16_t>() == schemas_.size(), "statistics: schemas");
    require(in.number<std::uint32_t>() == channels.size(), "statistics: channels");
    require(in.number<std::uint32_t>() == 0, "statistics: attachments");
    require(in.number<std::uint32_t>() == metadata_places_.size(), "statistics: metadata");
    require(in.number<std::uint32_t>() == chunks.size(), "statistics: chunks");
    std::uint64_t first = all.empty() ? 0 : UINT64_MAX;
    std::uint64_t last = 0;
    for (const Message& one : all) {
      first = std::min(first, one.at_ns);
      last = std::max(last, one.at_ns);
    }
    require(in.number<std::uint64_t>() == first, "statistics: begin");
    require(in.number<std::uint64_t>() == last, "statistics: end");
    const std::string by_channel = in.text();
    for (Cursor each{by_channel, faults}; !each.rest().empty();) {
      const std::string topic = channels.at(each.number<std::uint16_t>()).topic;
      require(each.number<std::uint64_t>() == counts[topic], "statistics: of " + topic);
      counts.erase(topic);
    }
    require(counts.empty(), "statistics: a channel is missing");
  }

  std::string file_{};
  std::map<std::uint16_t, std::string> schemas_{};
  std::map<std::uint64_t, std::string_view> message_indexes_{};
  std::map<std::pair<std::uint64_t, std::uint16_t>,
           std::vector<std::pair<std::uint64_t, std::uint64_t>>>
      entries_{};
  std::map<std::uint64_t, std::uint64_t> metadata_places_{};
  std::uint64_t summary_begin_{};
  std::size_t indexed_chunks_{};
  std::size_t indexed_metadata_{};
  std::size_t described_{};
};
