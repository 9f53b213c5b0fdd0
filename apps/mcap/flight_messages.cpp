// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/flight_messages.h"

#include "flyball/mcap/protobuf.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace flyball {
namespace {

SchemaField timestamp_field() {
  return {"timestamp", FieldType::message, "google.protobuf.Timestamp"};
}

SchemaField frame_field() {
  return {"frame_id", FieldType::text};
}

/// Foxglove's messages that are used here. tests/foxglove compares them with Foxglove's own.
std::vector<MessageSchema> foxglove_schemas() {
  const SchemaField x{"x", FieldType::real};
  const SchemaField y{"y", FieldType::real};
  const SchemaField z{"z", FieldType::real};
  return {
      {"google.protobuf.Timestamp",
       {{"seconds", FieldType::int64}, {"nanos", FieldType::int32}},
       {}},
      {"foxglove.Vector3", {x, y, z}, {}},
      {"foxglove.Quaternion", {x, y, z, {"w", FieldType::real}}, {}},
      {"foxglove.Pose",
       {{"position", FieldType::message, "foxglove.Vector3"},
        {"orientation", FieldType::message, "foxglove.Quaternion"}},
       {}},
      {"foxglove.PoseInFrame",
       {timestamp_field(), frame_field(), {"pose", FieldType::message, "foxglove.Pose"}},
       {}},
      {"foxglove.PosesInFrame",
       {timestamp_field(), frame_field(), {"poses", FieldType::message, "foxglove.Pose", true}},
       {}},
      {"foxglove.FrameTransform",
       {timestamp_field(),
        {"parent_frame_id", FieldType::text},
        {"child_frame_id", FieldType::text},
        {"translation", FieldType::message, "foxglove.Vector3"},
        {"rotation", FieldType::message, "foxglove.Quaternion"}},
       {}},
      {"foxglove.PackedElementField",
       {{"name", FieldType::text},
        {"offset", FieldType::fixed32},
        {"type", FieldType::choice, "NumericType"}},
       {{"NumericType",
         {"UNKNOWN", "UINT8", "INT8", "UINT16", "INT16", "UINT32", "INT32", "FLOAT32",
          "FLOAT64"}}}},
      {"foxglove.PointCloud",
       {timestamp_field(),
        frame_field(),
        {"pose", FieldType::message, "foxglove.Pose"},
        {"point_stride", FieldType::fixed32},
        {"fields", FieldType::message, "foxglove.PackedElementField", true},
        {"data", FieldType::bytes}},
       {}},
      {"foxglove.Log",
       {timestamp_field(),
        {"level", FieldType::choice, "Level"},
        {"message", FieldType::text},
        {"name", FieldType::text},
        {"file", FieldType::text},
        {"line", FieldType::fixed32}},
       {{"Level", {"UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"}}}},
  };
}

std::vector<MessageSchema> own_schemas() {
  return {
      {"flyball.Knob",
       {{"name", FieldType::text}, {"value", FieldType::real}, {"unit", FieldType::text}},
       {}},
      {"flyball.Knobs",
       {timestamp_field(),
        {"version", FieldType::uint64},
        {"knobs", FieldType::message, "flyball.Knob", true},
        {"granted_cores", FieldType::int32},
        {"granted_clock_hz", FieldType::real},
        {"bound_factor", FieldType::real},
        {"must_hover", FieldType::flag}},
       {}},
      {"flyball.Decision",
       {timestamp_field(),
        {"knob", FieldType::text},
        {"value", FieldType::real},
        {"before", FieldType::real},
        {"reason", FieldType::text}},
       {}},
      {"flyball.MessageVersion", {{"topic", FieldType::text}, {"version", FieldType::uint64}}, {}},
      {"flyball.WorkItem", {{"name", FieldType::text}, {"count", FieldType::real}}, {}},
      {"flyball.Job",
       {timestamp_field(),
        {"node", FieldType::text},
        {"released_s", FieldType::real},
        {"started_s", FieldType::real},
        {"ended_s", FieldType::real},
        {"busy_s", FieldType::real},
        {"core", FieldType::int32},
        {"clock_hz", FieldType::real},
        {"missed", FieldType::flag},
        {"killed", FieldType::flag},
        {"kernel", FieldType::text},
        {"work", FieldType::message, "flyball.WorkItem", true},
        {"reads", FieldType::message, "flyball.MessageVersion", true}},
       {}},
      {"flyball.Power",
       {timestamp_field(),
        {"computer_w", FieldType::real},
        {"rotor_w", FieldType::real},
        {"battery_percent", FieldType::real},
        {"battery_v", FieldType::real}},
       {}},
      {"flyball.Field",
       {{"name", FieldType::text},
        {"number", FieldType::real},
        {"whole", FieldType::int64},
        {"text", FieldType::text}},
       {}},
      {"flyball.Row",
       {timestamp_field(),
        {"channel", FieldType::text},
        {"fields", FieldType::message, "flyball.Field", true}},
       {}},
  };
}

/// A negative number too is written as a number of 64 bits.
std::uint64_t whole(std::int64_t value) {
  return static_cast<std::uint64_t>(value);
}

Protobuf timestamp(MissionTime at) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  const std::int64_t ns = at.time_since_epoch().count();
  return Protobuf{}.number(1, whole(ns / ns_per_s)).number(2, whole(ns % ns_per_s));
}

/// With its time as the first field, as all messages here have it.
Protobuf message_at(MissionTime at) {
  return Protobuf{}.message(1, timestamp(at));
}

Protobuf vector(const Vec3& p) {
  return Protobuf{}.real(1, p.x()).real(2, p.y()).real(3, p.z());
}

Protobuf quaternion(const Eigen::Quaterniond& q) {
  return Protobuf{}.real(1, q.x()).real(2, q.y()).real(3, q.z()).real(4, q.w());
}

Protobuf pose(const Vec3& p, const Eigen::Quaterniond& q) {
  return Protobuf{}.message(1, vector(p)).message(2, quaternion(q));
}

Eigen::Quaterniond rotation_of(const Pose& X) {
  return Eigen::Quaterniond{X.linear()};
}

/// The number of a row's field; empty when it has none of this name, or a text.
const double* number_of(const LogRow& row, std::string_view name) {
  const auto found = std::find_if(row.fields.begin(), row.fields.end(),
                                  [&](const Field& one) { return one.name == name; });
  return found != row.fields.end() ? std::get_if<double>(&found->value) : nullptr;
}

const std::string* text_of(const LogRow& row, std::string_view name) {
  const auto found = std::find_if(row.fields.begin(), row.fields.end(),
                                  [&](const Field& one) { return one.name == name; });
  return found != row.fields.end() ? std::get_if<std::string>(&found->value) : nullptr;
}

/// Fields of the row, where it has them, as fields of the message.
void add_numbers(Protobuf& out,
                 const LogRow& row,
                 const std::vector<std::pair<int, std::string_view>>& fields) {
  for (const auto& [field, name] : fields) {
    if (const double* value = number_of(row, name)) {
      out.real(field, *value);
    }
  }
}

void add_texts(Protobuf& out,
               const LogRow& row,
               const std::vector<std::pair<int, std::string_view>>& fields) {
  for (const auto& [field, name] : fields) {
    if (const std::string* value = text_of(row, name)) {
      out.text(field, *value);
    }
  }
}

/// As `cells_message` packs a cell.
enum class NumericType : std::uint8_t { uint8 = 1, float32 = 7 };

Protobuf packed(std::string_view name, std::uint32_t offset, NumericType type) {
  return Protobuf{}.text(1, name).fixed32(2, offset).number(3, static_cast<std::uint64_t>(type));
}

void pack(std::string& out, double value) {
  const auto number = static_cast<float>(value);
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  out.append(bytes, sizeof number);
}

}  // namespace

std::vector<MessageSchema> flight_schemas() {
  std::vector<MessageSchema> all = foxglove_schemas();
  for (MessageSchema& one : own_schemas()) {
    all.push_back(std::move(one));
  }
  return all;
}

std::string pose_message(MissionTime at, const Pose& X_WB) {
  return message_at(at)
      .text(2, world_frame)
      .message(3, pose(X_WB.translation(), rotation_of(X_WB)))
      .bytes();
}

std::string transform_message(MissionTime at, const Pose& X_WB) {
  return message_at(at)
      .text(2, world_frame)
      .text(3, body_frame)
      .message(4, vector(X_WB.translation()))
      .message(5, quaternion(rotation_of(X_WB)))
      .bytes();
}

std::string path_message(MissionTime at, const std::vector<Vec3>& path_W) {
  Protobuf out = message_at(at);
  out.text(2, world_frame);
  double yaw_rad = 0.0;
  for (std::size_t i = 0; i < path_W.size(); ++i) {
    yaw_rad = i + 1 < path_W.size() ? yaw_of(path_W[i + 1] - path_W[i]) : yaw_rad;
    out.message(3, pose(path_W[i], Eigen::Quaterniond{Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}}));
  }
  return out.bytes();
}

std::string cells_message(MissionTime at, double size_m, const std::vector<CellChange>& cells) {
  constexpr std::uint32_t stride = 4 * sizeof(float) + 1;
  std::string points;
  points.reserve(cells.size() * stride);
  for (const CellChange& cell : cells) {
    pack(points, cell.centre_W.x());
    pack(points, cell.centre_W.y());
    pack(points, cell.centre_W.z());
    pack(points, size_m);
    points.push_back(cell.is_occupied ? '\1' : '\0');
  }
  return message_at(at)
      .text(2, world_frame)
      .message(3, pose(Vec3::Zero(), Eigen::Quaterniond::Identity()))
      .fixed32(4, stride)
      .message(5, packed("x", 0, NumericType::float32))
      .message(5, packed("y", 4, NumericType::float32))
      .message(5, packed("z", 8, NumericType::float32))
      .message(5, packed("size_m", 12, NumericType::float32))
      .message(5, packed("occupied", 16, NumericType::uint8))
      .text(6, points)
      .bytes();
}

std::string log_message(MissionTime at, const std::string& what) {
  constexpr std::uint64_t level_info = 2;
  return message_at(at).number(2, level_info).text(3, what).text(4, "flyball").bytes();
}

std::string knobs_message(MissionTime at, const KnobsInForce& knobs) {
  Protobuf out = message_at(at);
  out.number(2, knobs.version);
  for (const KnobSpec& spec : knobs.knobs.specs()) {
    out.message(3,
                Protobuf{}.text(1, spec.name).real(2, knobs.value(spec.name)).text(3, spec.unit));
  }
  return out.number(4, whole(knobs.computer.cores))
      .real(5, knobs.computer.frequency.value())
      .real(6, knobs.restraint.bound_factor)
      .number(7, knobs.restraint.must_hover ? 1 : 0)
      .bytes();
}

std::string job_message(const JobRecord& job, const Graph& graph) {
  Protobuf out = message_at(job.ended);
  out.text(2, graph.nodes()[static_cast<std::size_t>(job.node)].spec.name)
      .real(3, to_seconds(job.released))
      .real(4, to_seconds(job.started))
      .real(5, to_seconds(job.ended))
      .real(6, to_seconds(job.busy))
      .number(7, whole(job.core))
      .real(8, job.clock.value())
      .number(9, job.missed ? 1 : 0)
      .number(10, job.killed ? 1 : 0)
      .text(11, job.work.charged_as());
  for (const WorkItem& item : job.work.items()) {
    out.message(12, Protobuf{}.text(1, item.name).real(2, item.count));
  }
  for (const MessageVersion& read : job.reads) {
    out.message(13, Protobuf{}
                        .text(1, graph.topics()[static_cast<std::size_t>(read.topic)].name)
                        .number(2, read.version));
  }
  return out.bytes();
}

std::string decision_message(const LogRow& row) {
  Protobuf out = message_at(row.at);
  add_texts(out, row, {{2, "knob"}, {5, "reason"}});
  add_numbers(out, row, {{3, "value"}, {4, "before"}});
  return out.bytes();
}

std::string power_message(const LogRow& row) {
  Protobuf out = message_at(row.at);
  add_numbers(out, row,
              {{2, "computer_w"}, {3, "rotor_w"}, {4, "battery_percent"}, {5, "battery_v"}});
  return out.bytes();
}

std::string row_message(const LogRow& row) {
  Protobuf out = message_at(row.at);
  out.text(2, row.channel);
  for (const Field& field : row.fields) {
    Protobuf one;
    one.text(1, field.name);
    if (const auto* number = std::get_if<double>(&field.value)) {
      one.real(2, *number);
    } else if (const auto* value = std::get_if<std::int64_t>(&field.value)) {
      one.number(3, whole(*value));
    } else {
      one.text(4, std::get<std::string>(field.value));
    }
    out.message(3, one);
  }
  return out.bytes();
}

}  // namespace flyball
