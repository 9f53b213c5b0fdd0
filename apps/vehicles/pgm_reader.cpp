// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/pgm_reader.h"

#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace flyball {
namespace {

constexpr std::size_t longest_header = 1024;
constexpr int largest_px = 8192;  // Each way, of any depth camera.

Error no_image(const std::string& why) {
  return {ErrorCode::invalid_input, "comes no PGM image of 16 bits (\"P5\"): " + why};
}

bool is_space(std::uint8_t byte) {
  return std::isspace(byte) != 0;
}

/// Words of a header, which comments may stand between.
class HeaderWords {
 public:
  explicit HeaderWords(const std::vector<std::uint8_t>& bytes) : bytes_{bytes} {}

  /// Empty where the word, or the blank behind it, has not come yet.
  std::optional<std::string> next() {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      const bool is_comment = bytes_[at_] == '#';
      while (is_comment && at_ < bytes_.size() && bytes_[at_] != '\n') {
        ++at_;
      }
      at_ += at_ < bytes_.size() ? 1U : 0U;
    }
    std::string word;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) {
      word.push_back(static_cast<char>(bytes_[at_++]));
    }
    return at_ < bytes_.size() ? std::optional{word} : std::nullopt;
  }
  /// Behind the one blank that ends a header.
  [[nodiscard]] std::size_t end() const { return at_ + 1; }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_{};
};

/// 0: it is no number, or too large for any use here.
int number(const std::string& word) {
  const bool is_number = !word.empty() && word.size() <= 5 &&
                         word.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::stoi(word) : 0;
}

}  // namespace

Result<std::optional<PgmReader::Header>> PgmReader::header() const {
  if (!waiting_.empty() && waiting_[0] != 'P') {
    return no_image("it begins with byte " + std::to_string(int{waiting_[0]}));
  }
  HeaderWords words{waiting_};
  std::array<std::string, 4> read{};
  for (std::string& word : read) {
    const auto next = words.next();
    if (!next) {
      return waiting_.size() < longest_header
                 ? Result<std::optional<Header>>{std::optional<Header>{}}
                 : Result<std::optional<Header>>{no_image("its header does not end")};
    }
    word = *next;
  }
  const Header header{number(read[1]), number(read[2]), words.end()};
  const auto is_side = [](int px) { return px >= 1 && px <= largest_px; };
  constexpr int one_byte = 255;
  if (read[0] != "P5" || !is_side(header.width_px) || !is_side(header.height_px)) {
    return no_image("its header is \"" + read[0] + " " + read[1] + " " + read[2] + "\"");
  }
  if (number(read[3]) <= one_byte) {
    return no_image("its largest value is " + read[3] + ", so that a pixel has 8 bits");
  }
  return std::optional{header};
}

Status PgmReader::read(const std::uint8_t* bytes, std::size_t count) {
  waiting_.insert(waiting_.end(), bytes, bytes + count);
  while (true) {
    const auto found = header();
    if (!found) {
      return found.error();
    }
    if (!*found || waiting_.size() < (*found)->image_bytes()) {
      return Done{};
    }
    const Header& header = **found;
    PgmImage image{header.width_px, header.height_px, {}};
    image.values.reserve((header.image_bytes() - header.bytes) / 2);
    for (std::size_t at = header.bytes; at < header.image_bytes(); at += 2) {
      image.values.push_back(
          static_cast<std::uint16_t>((unsigned{waiting_[at]} << 8U) | waiting_[at + 1]));
    }
    newest_ = std::move(image);
    waiting_.erase(waiting_.begin(),
                   waiting_.begin() + static_cast<std::ptrdiff_t>(header.image_bytes()));
  }
}

std::optional<PgmImage> PgmReader::take() {
  return std::exchange(newest_, std::nullopt);
}

}  // namespace flyball
