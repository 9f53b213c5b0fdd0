// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/recorder.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace flyball {

namespace {

constexpr std::uint64_t fnv_prime = 0x100000001b3ULL;

void add_field(TraceHash& hash, const Field& field) {
  hash.add(field.name);
  hash.add(static_cast<std::uint64_t>(field.value.index()));
  if (const double* number = std::get_if<double>(&field.value)) {
    hash.add(*number);
  } else if (const std::int64_t* whole = std::get_if<std::int64_t>(&field.value)) {
    hash.add(static_cast<std::uint64_t>(*whole));
  } else {
    hash.add(std::string_view{std::get<std::string>(field.value)});
  }
}

}  // namespace

void TraceHash::add(std::uint64_t bits) {
  for (int byte = 0; byte < 8; ++byte) {
    hash_ = (hash_ ^ ((bits >> (8 * byte)) & 0xffU)) * fnv_prime;
  }
}

void TraceHash::add(std::string_view text) {
  add(static_cast<std::uint64_t>(text.size()));  // else "ab","c" and "a","bc" would be the same
  for (const char c : text) {
    hash_ = (hash_ ^ static_cast<unsigned char>(c)) * fnv_prime;
  }
}

void TraceHash::add(double value) {
  double canonical = value == 0.0 ? 0.0 : value;
  if (std::isnan(value)) {
    canonical = std::numeric_limits<double>::quiet_NaN();  // the sign of a NaN means nothing
  }
  std::uint64_t bits{};
  std::memcpy(&bits, &canonical, sizeof bits);
  add(bits);
}

std::string TraceHash::hex() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
  return text;
}

namespace {

/// In memory, about.
std::size_t size_of(const std::vector<Field>& row) {
  std::size_t bytes = sizeof(MemoryRecorder::Row) + row.size() * sizeof(Field);
  for (const Field& field : row) {
    const auto* text = std::get_if<std::string>(&field.value);
    bytes += text != nullptr ? text->size() : 0;
  }
  return bytes;
}

}  // namespace

void MemoryRecorder::record(MissionTime at,
                            std::string_view channel,
                            const std::vector<Field>& row) {
  hash_.add(static_cast<std::uint64_t>(at.time_since_epoch().count()));
  hash_.add(channel);
  hash_.add(static_cast<std::uint64_t>(row.size()));
  for (const Field& field : row) {
    add_field(hash_, field);
  }
  if (is_full_) {
    return;
  }
  bytes_ += size_of(row);
  is_full_ = bytes_ > most_bytes_;
  if (is_full_) {
    rows_.push_back({at,
                     "event",
                     {{"what", std::string{"the record is full; what follows is "
                                           "part of its hash only"}}}});
    return;
  }
  rows_.push_back({at, std::string{channel}, row});
}

}  // namespace flyball
