// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/mcap_writer.h"

#include "flyball/runtime/assert.h"

#include "mcap/mcap_output.h"
#include <algorithm>
#include <utility>

#include <zstd.h>

namespace flyball {
namespace {

// Its fastest, which on protobuf's small numbers saves nearly as much as the slower ones.
constexpr int compression_level = 1;

struct FreeContext {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

std::uint64_t nanoseconds(MissionTime at) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(at.time_since_epoch().count(), 0));
}

void describe(McapOutput& output, const McapSettings& settings) {
  std::map<std::string, std::uint16_t> ids;
  for (const McapChannel& channel : settings.channels) {
    if (ids.count(channel.schema) == 0) {
      const auto id = static_cast<std::uint16_t>(ids.size() + 1);  // 0 stands for no schema.
      ids[channel.schema] = id;
      output.add_schema(McapPacker{}
                            .number(id)
                            .text(channel.schema)
                            .text("protobuf")
                            .text(descriptor_set(settings.schemas, channel.schema))
                            .bytes());
    }
  }
  std::uint16_t id = 0;
  for (const McapChannel& channel : settings.channels) {
    output.add_channel(McapPacker{}
                           .number(id++)
                           .number(ids[channel.schema])
                           .text(channel.topic)
                           .text("protobuf")
                           .map({})
                           .bytes());
  }
}

}  // namespace

struct McapWriter::Parts {
  McapSettings settings;
  std::unique_ptr<McapOutput> output;
  std::unique_ptr<ZSTD_CCtx, FreeContext> context{ZSTD_createCCtx()};
  std::string chunk{};       ///< Records of the open one.
  std::string compressed{};  ///< Of the one that is being closed.
  ChunkHead head{};
  MessageOffsets offsets{};
};

Result<std::unique_ptr<McapWriter>> McapWriter::open(const std::string& path,
                                                     const McapSettings& settings) {
  FLYBALL_ASSERT(settings.channels.size() <= UINT16_MAX, "%zu channels", settings.channels.size());
  auto output = McapOutput::open(path);
  if (!output) {
    return output.error();
  }
  describe(**output, settings);
  if (!(*output)->status()) {
    return (*output)->status().error();
  }
  auto parts = std::make_unique<Parts>();
  parts->settings = settings;
  parts->output = std::move(*output);
  parts->chunk.reserve(settings.chunk_bytes + settings.chunk_bytes / 8);
  return std::unique_ptr<McapWriter>{new McapWriter{std::move(parts)}};
}

McapWriter::McapWriter(std::unique_ptr<Parts> parts) : parts_{std::move(parts)} {}
McapWriter::~McapWriter() = default;

void McapWriter::add(std::size_t channel,
                     std::uint32_t sequence,
                     MissionTime at,
                     std::string_view message) {
  Parts& p = *parts_;
  FLYBALL_ASSERT(channel < p.settings.channels.size(), "no channel %zu", channel);
  const std::uint64_t at_ns = nanoseconds(at);
  if (has_open_chunk() &&
      at_ns >= p.head.begin_ns + static_cast<std::uint64_t>(p.settings.chunk_time.count())) {
    close_chunk();
  }
  if (!has_open_chunk()) {
    p.head = {at_ns, at_ns, 0, 0};
  }
  p.head.begin_ns = std::min(p.head.begin_ns, at_ns);
  p.head.end_ns = std::max(p.head.end_ns, at_ns);
  const auto id = static_cast<std::uint16_t>(channel);
  p.offsets[id].emplace_back(at_ns, p.chunk.size());
  constexpr std::uint64_t head_bytes = 2 + 4 + 8 + 8;
  p.chunk += McapPacker{}
                 .number(static_cast<std::uint8_t>(McapOpcode::message))
                 .number(head_bytes + message.size())
                 .number(id)
                 .number(sequence)
                 .number(at_ns)
                 .number(at_ns)
                 .bytes();
  p.chunk += message;
  if (p.chunk.size() >= p.settings.chunk_bytes) {
    close_chunk();
  }
}

bool McapWriter::has_open_chunk() const {
  return !parts_->chunk.empty();
}

void McapWriter::close_chunk() {
  if (!has_open_chunk()) {
    return;
  }
  Parts& p = *parts_;
  p.head.uncompressed_bytes = p.chunk.size();
  p.head.crc = crc32(p.chunk);
  p.compressed.resize(ZSTD_compressBound(p.chunk.size()));
  const std::size_t bytes =
      ZSTD_compressCCtx(p.context.get(), p.compressed.data(), p.compressed.size(), p.chunk.data(),
                        p.chunk.size(), compression_level);
  FLYBALL_ASSERT(ZSTD_isError(bytes) == 0U, "zstd: %s", ZSTD_getErrorName(bytes));
  p.output->add_chunk(p.head, std::string_view{p.compressed}.substr(0, bytes), p.offsets);
  if (p.settings.survives_power_loss) {
    p.output->sync();
  }
  p.chunk.clear();
  p.offsets.clear();
}

void McapWriter::add_metadata(const std::string& name,
                              const std::map<std::string, std::string>& values) {
  close_chunk();
  parts_->output->add_metadata(name, values);
}

Status McapWriter::close() {
  close_chunk();
  return parts_->output->finish(parts_->settings.survives_power_loss);
}

Status McapWriter::status() const {
  return parts_->output->status();
}

std::size_t McapWriter::chunks() const {
  return parts_->output->chunks();
}

}  // namespace flyball
