// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/mcap_recovery.h"

#include "mcap/mcap_output.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>
#include <zstd.h>

namespace flyball {
namespace {

namespace fs = std::filesystem;

// Chosen: many times a chunk of ours. A length beyond it was never written, it is damage.
constexpr std::uint64_t most_record_bytes = std::uint64_t{1} << 28U;

/// Takes the records of a file one by one.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path)
      : in_{path, std::ios::binary}, left_{in_ ? fs::file_size(path) : 0} {}
  [[nodiscard]] std::string take(std::uint64_t bytes) {
    std::string part(std::min(bytes, left_), '\0');
    in_.read(part.data(), static_cast<std::streamsize>(part.size()));
    part.resize(static_cast<std::size_t>(std::max<std::streamsize>(in_.gcount(), 0)));
    left_ -= part.size();
    return part;
  }
  /// Empty at the end, and where nothing like a record stands; `left` is then what is behind the
  /// last one.
  [[nodiscard]] std::optional<McapOpcode> next(std::string& content) {
    const std::uint64_t before = left_;
    const std::string head = take(mcap_record_head_bytes);
    McapUnpacker in{head};
    const auto opcode = in.number<std::uint8_t>();
    const auto bytes = in.number<std::uint64_t>();
    // A file system that lost its power may leave zeros.
    if (!in.is_good() || opcode == 0 || bytes > left_ || bytes > most_record_bytes) {
      left_ = before;
      return std::nullopt;
    }
    content = take(bytes);
    return static_cast<McapOpcode>(opcode);
  }
  [[nodiscard]] std::uint64_t left() const { return left_; }
  [[nodiscard]] bool ends_with_magic() {
    in_.seekg(-static_cast<std::streamoff>(mcap_magic.size()), std::ios::end);
    left_ = mcap_magic.size();
    return take(left_) == mcap_magic;
  }

 private:
  std::ifstream in_;
  std::uint64_t left_;
};

/// What a record Chunk holds, uncompressed; empty when it is damaged, or not compressed by zstd.
std::optional<std::string> records_of(const ChunkHead& head,
                                      std::string_view compression,
                                      std::string_view compressed) {
  if (compression != mcap_zstd || head.uncompressed_bytes > most_record_bytes) {
    return std::nullopt;
  }
  std::string records(head.uncompressed_bytes, '\0');
  const std::size_t bytes =
      ZSTD_decompress(records.data(), records.size(), compressed.data(), compressed.size());
  const bool is_whole = ZSTD_isError(bytes) == 0U && bytes == records.size() &&
                        (head.crc == 0 || head.crc == crc32(records));  // 0: it has none.
  return is_whole ? std::optional{std::move(records)} : std::nullopt;
}

class Recovery {
 public:
  Recovery(RecordFile& from, McapOutput& to) : from_{from}, to_{to} {}

  McapRecovery run() {
    std::string content;
    while (const auto opcode = from_.next(content)) {
      if (*opcode == McapOpcode::data_end) {
        return finished(0);
      }
      take(*opcode, content);
    }
    return finished(from_.left());
  }

 private:
  struct Rows {
    std::uint64_t count{};
    std::uint64_t next_sequence{};
  };

  McapRecovery finished(std::uint64_t lost_bytes) {
    done_.lost_bytes = lost_bytes;
    done_.was_whole = lost_bytes == 0 && from_.ends_with_magic();
    done_.chunks = to_.chunks();
    done_.messages = to_.messages();
    for (const auto& [channel, rows] : rows_) {
      done_.missing_rows += rows.next_sequence - std::min(rows.count, rows.next_sequence);
    }
    to_.add_metadata("flyball.recovery", {{"damaged_chunks", std::to_string(done_.damaged_chunks)},
                                          {"lost_bytes", std::to_string(done_.lost_bytes)},
                                          {"missing_rows", std::to_string(done_.missing_rows)}});
    return done_;
  }

  void take(McapOpcode opcode, const std::string& content) {
    McapUnpacker in{content};
    if (opcode == McapOpcode::schema || opcode == McapOpcode::channel) {
      describe(opcode, content);
    } else if (opcode == McapOpcode::chunk) {
      done_.damaged_chunks += take_chunk(in) ? 0 : 1;
    } else if (opcode == McapOpcode::metadata) {
      const std::string name{in.text()};
      const auto values = in.map();
      if (in.is_good()) {
        to_.add_metadata(name, values);
      }
    }
  }

  /// Damaged descriptions are left out, and with them the chunks that need them.
  void describe(McapOpcode opcode, std::string_view content) {
    McapUnpacker in{content};
    const auto id = in.number<std::uint16_t>();
    const bool is_schema = opcode == McapOpcode::schema;
    const std::uint16_t schema = is_schema ? id : in.number<std::uint16_t>();
    (void)in.text();  // Name of the schema, topic of the channel.
    (void)in.text();  // Encoding.
    (void)in.text();  // The schema itself, metadata of the channel.
    if (!in.is_good() || !in.rest().empty()) {
      return;
    }
    if (is_schema && schemas_.insert(id).second) {
      to_.add_schema(content);
    } else if (!is_schema && (schema == 0 || schemas_.count(schema) > 0) &&
               channels_.insert(id).second) {
      to_.add_channel(content);
    }
  }

  [[nodiscard]] bool take_chunk(McapUnpacker& in) {
    ChunkHead head;
    head.begin_ns = in.number<std::uint64_t>();
    head.end_ns = in.number<std::uint64_t>();
    head.uncompressed_bytes = in.number<std::uint64_t>();
    head.crc = in.number<std::uint32_t>();
    const std::string_view compression = in.text();
    const std::string_view compressed = in.raw(in.number<std::uint64_t>());
    const auto records = in.is_good() ? records_of(head, compression, compressed) : std::nullopt;
    const auto offsets = records ? offsets_of(*records) : std::nullopt;
    if (!offsets) {
      return false;
    }
    head = {UINT64_MAX, 0, head.uncompressed_bytes, crc32(*records)};
    for (const auto& [channel, messages] : *offsets) {
      for (const auto& [at_ns, offset] : messages) {
        head.begin_ns = std::min(head.begin_ns, at_ns);
        head.end_ns = std::max(head.end_ns, at_ns);
      }
    }
    if (offsets->empty()) {
      return false;
    }
    count(head, *offsets, *records);
    to_.add_chunk(head, compressed, *offsets);
    return true;
  }

  /// Of the messages among these records; empty when they do not end with a whole one, or belong to
  /// an unknown channel.
  std::optional<MessageOffsets> offsets_of(const std::string& records) {
    MessageOffsets offsets;
    for (std::string_view left = records; !left.empty();) {
      const std::size_t offset = records.size() - left.size();
      const auto record = take_record(left);
      if (!record) {
        return std::nullopt;
      }
      if (record->opcode == McapOpcode::schema || record->opcode == McapOpcode::channel) {
        describe(record->opcode, record->content);
      }
      if (record->opcode != McapOpcode::message) {
        continue;
      }
      McapUnpacker in{record->content};
      const auto channel = in.number<std::uint16_t>();
      (void)in.number<std::uint32_t>();  // Its sequence number.
      const auto at_ns = in.number<std::uint64_t>();
      if (!in.is_good() || channels_.count(channel) == 0) {
        return std::nullopt;
      }
      offsets[channel].emplace_back(at_ns, offset);
    }
    return offsets;
  }

  void count(const ChunkHead& head, const MessageOffsets& offsets, std::string_view records) {
    const auto at = [](std::uint64_t ns) {
      return MissionTime{Duration{static_cast<std::int64_t>(ns)}};
    };
    done_.begin = to_.chunks() == 0 ? at(head.begin_ns) : std::min(done_.begin, at(head.begin_ns));
    done_.end = std::max(done_.end, at(head.end_ns));
    for (const auto& [channel, messages] : offsets) {
      Rows& rows = rows_[channel];
      rows.count += messages.size();
      for (const auto& [at_ns, offset] : messages) {
        McapUnpacker in{records.substr(offset + mcap_record_head_bytes)};
        (void)in.number<std::uint16_t>();  // Its channel.
        rows.next_sequence =
            std::max<std::uint64_t>(rows.next_sequence, in.number<std::uint32_t>() + 1ULL);
      }
    }
  }

  RecordFile& from_;
  McapOutput& to_;
  McapRecovery done_{};
  std::set<std::uint16_t> schemas_{};
  std::set<std::uint16_t> channels_{};
  std::map<std::uint16_t, Rows> rows_{};
};

Status check_names(const std::string& broken, const std::string& out) {
  std::error_code failed;
  if (!fs::is_regular_file(broken, failed)) {
    return Error{ErrorCode::not_found, "no file \"" + broken + "\""};
  }
  if (!std::ifstream{broken}) {
    return Error{ErrorCode::unavailable, "the file \"" + broken + "\" cannot be read"};
  }
  if (fs::equivalent(broken, out, failed)) {
    return Error{ErrorCode::invalid_input,
                 "\"" + out + "\" is the broken file itself; name another one with --out"};
  }
  return Done{};
}

}  // namespace

Result<McapRecovery> recover_mcap(const std::string& broken, const std::string& out) {
  if (const Status good = check_names(broken, out); !good) {
    return good.error();
  }
  RecordFile from{broken};
  if (from.take(mcap_magic.size()) != mcap_magic) {
    return Error{ErrorCode::invalid_input,
                 "\"" + broken + "\" is no MCAP file: it does not begin like one"};
  }
  // Of this process: the broken file may have the name that such a file has.
  const std::string part = out + "." + std::to_string(getpid()) + ".part";
  auto to = McapOutput::open(part);
  if (!to) {
    return to.error();
  }
  const McapRecovery done = Recovery{from, **to}.run();
  const Status written = (*to)->finish(false);
  std::error_code failed;
  if (done.chunks > 0 && written) {
    fs::rename(part, out, failed);
    if (!failed) {
      return done;
    }
  }
  std::error_code ignored;
  fs::remove(part, ignored);
  if (!written) {
    return written.error();
  }
  return failed
             ? Error{ErrorCode::unavailable, "\"" + out + "\" cannot be made: " + failed.message()}
             : Error{ErrorCode::invalid_input,
                     "\"" + broken + "\" ends before its first chunk does: nothing to recover"};
}

}  // namespace flyball
