// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mcap_writer
#include "mcap/mcap_output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace flyball {
namespace {

std::string reason(int number) {
  return std::strerror(number);  // NOLINT(concurrency-mt-unsafe): glibc's is safe per thread.
}

/// Appends the indexes of one chunk's messages; where each one begins goes to `place`.
void append_indexes(std::string& out,
                    std::uint64_t begins_at,
                    const MessageOffsets& offsets,
                    ChunkPlace& place) {
  const std::size_t before = out.size();
  for (const auto& [channel, messages] : offsets) {
    place.index_offsets[channel] = begins_at + out.size();
    McapPacker entries;
    for (const auto& [time_ns, offset] : messages) {
      entries.number(time_ns).number(offset);
    }
    append_record(out, McapOpcode::message_index,
                  McapPacker{}.number(channel).text(entries.bytes()).bytes());
  }
  place.index_bytes = out.size() - before;
}

/// The groups of records in a summary, and behind them where each group lies.
class SummaryText {
 public:
  explicit SummaryText(std::uint64_t begins_at) : begins_at_{begins_at} {}
  void add(McapOpcode opcode, const std::string& records) {
    if (records.empty()) {
      return;
    }
    append_record(offsets_, McapOpcode::summary_offset,
                  McapPacker{}
                      .number(static_cast<std::uint8_t>(opcode))
                      .number(begins_at_ + groups_.size())
                      .number(static_cast<std::uint64_t>(records.size()))
                      .bytes());
    groups_ += records;
  }
  /// With the footer, whose CRC covers the summary and the footer's own first fields.
  [[nodiscard]] std::string finished() const {
    std::string all = groups_ + offsets_;
    constexpr std::uint64_t footer_bytes = 8 + 8 + 4;
    all += McapPacker{}
               .number(static_cast<std::uint8_t>(McapOpcode::footer))
               .number(footer_bytes)
               .number(begins_at_)
               .number(begins_at_ + groups_.size())
               .bytes();
    return all + McapPacker{}.number(crc32(all)).bytes();
  }

 private:
  std::uint64_t begins_at_;
  std::string groups_{};
  std::string offsets_{};
};

}  // namespace

Result<std::unique_ptr<McapOutput>> McapOutput::open(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    return Error{ErrorCode::unavailable,
                 "the record \"" + path + "\" cannot be made: " + reason(errno)};
  }
  std::unique_ptr<McapOutput> output{new McapOutput{path, descriptor}};
  std::string begin{mcap_magic};
  append_record(begin, McapOpcode::header, McapPacker{}.text("").text("flyball").bytes());
  output->write(begin);
  return output;
}

McapOutput::McapOutput(std::string path, int descriptor)
    : path_{std::move(path)}, descriptor_{descriptor} {}

McapOutput::~McapOutput() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void McapOutput::write(std::string_view bytes) {
  crc_ = crc32(bytes, crc_);
  offset_ += bytes.size();
  while (status_ && !bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      status_ = Error{ErrorCode::failed, "the record \"" + path_ +
                                             "\" cannot be written on: " + reason(errno) +
                                             "; what it holds until then: flyball log recover"};
    }
  }
}

void McapOutput::add_description(McapOpcode opcode, std::string_view content) {
  std::string record;
  append_record(record, opcode, content);
  write(record);
  if (opcode == McapOpcode::schema) {
    schemas_ += record;
    ++schema_count_;
  } else {
    channels_ += record;
    ++channel_count_;
  }
}

void McapOutput::add_chunk(const ChunkHead& head,
                           std::string_view compressed,
                           const MessageOffsets& offsets) {
  ChunkPlace place;
  place.head = head;
  place.offset = offset_;
  place.compressed_bytes = compressed.size();
  McapPacker content;
  content.number(head.begin_ns)
      .number(head.end_ns)
      .number(head.uncompressed_bytes)
      .number(head.crc)
      .text(mcap_zstd)
      .number(static_cast<std::uint64_t>(compressed.size()));
  buffer_.clear();
  buffer_ += McapPacker{}
                 .number(static_cast<std::uint8_t>(McapOpcode::chunk))
                 .number(static_cast<std::uint64_t>(content.bytes().size() + compressed.size()))
                 .raw(content.bytes())
                 .bytes();
  buffer_ += compressed;
  place.bytes = buffer_.size();
  append_indexes(buffer_, offset_, offsets, place);
  for (const auto& [channel, messages] : offsets) {
    channel_messages_[channel] += messages.size();
    messages_ += messages.size();
  }
  write(buffer_);
  chunks_.push_back(std::move(place));
}

void McapOutput::add_metadata(const std::string& name,
                              const std::map<std::string, std::string>& values) {
  std::string record;
  append_record(record, McapOpcode::metadata, McapPacker{}.text(name).map(values).bytes());
  metadata_.push_back({name, offset_, record.size()});
  write(record);
}

void McapOutput::sync() {
  if (status_ && ::fdatasync(descriptor_) != 0 && errno != EINVAL) {  // EINVAL: a pipe, or such.
    status_ = Error{ErrorCode::failed,
                    "the record \"" + path_ + "\" does not reach the disk: " + reason(errno)};
  }
}

std::string McapOutput::statistics() const {
  std::uint64_t begin_ns = messages_ == 0 ? 0 : UINT64_MAX;
  std::uint64_t end_ns = 0;
  for (const ChunkPlace& chunk : chunks_) {
    begin_ns = std::min(begin_ns, chunk.head.begin_ns);
    end_ns = std::max(end_ns, chunk.head.end_ns);
  }
  McapPacker counts;
  for (const auto& [channel, count] : channel_messages_) {
    counts.number(channel).number(count);
  }
  McapPacker content;
  content.number(messages_)
      .number(schema_count_)
      .number(channel_count_)
      .number(std::uint32_t{0})  // Attachments.
      .number(static_cast<std::uint32_t>(metadata_.size()))
      .number(static_cast<std::uint32_t>(chunks_.size()))
      .number(begin_ns)
      .number(end_ns)
      .text(counts.bytes());
  std::string record;
  append_record(record, McapOpcode::statistics, content.bytes());
  return record;
}

std::string McapOutput::summary() const {
  std::string chunk_indexes;
  for (const ChunkPlace& chunk : chunks_) {
    chunk_indexes += index_record(chunk);
  }
  std::string metadata_indexes;
  for (const MetadataPlace& one : metadata_) {
    append_record(metadata_indexes, McapOpcode::metadata_index,
                  McapPacker{}.number(one.offset).number(one.bytes).text(one.name).bytes());
  }
  SummaryText text{offset_};
  text.add(McapOpcode::schema, schemas_);
  text.add(McapOpcode::channel, channels_);
  text.add(McapOpcode::statistics, statistics());
  text.add(McapOpcode::chunk_index, chunk_indexes);
  text.add(McapOpcode::metadata_index, metadata_indexes);
  return text.finished();
}

Status McapOutput::finish(bool syncs) {
  std::string data_end;
  append_record(data_end, McapOpcode::data_end, McapPacker{}.number(crc_).bytes());
  write(data_end);
  write(summary());
  write(mcap_magic);
  if (syncs) {
    sync();
  }
  if (::close(descriptor_) != 0 && status_) {
    status_ =
        Error{ErrorCode::failed, "the record \"" + path_ + "\" cannot be closed: " + reason(errno)};
  }
  descriptor_ = -1;
  return status_;
}

}  // namespace flyball
