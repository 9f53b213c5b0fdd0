// SPDX-License-Identifier: BSD-3-Clause
#include "lua_source.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

namespace flyball {
namespace {

/// Reads Lua's lexical elements as far as it takes to tell code from texts and comments (the
/// manual's section 3.1).
class ScriptReader {
 public:
  explicit ScriptReader(const std::string& text) : text_{text} {
    if (constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; starts_with(byte_order_mark)) {
      at_ = byte_order_mark.size();
    }
    if (starts_with("#")) {  // The line's end stays, so that messages count lines as editors do.
      at_ = std::min(text_.find('\n', at_), text_.size());
    }
  }

  Result<std::string> prepared() {
    if (const std::size_t zero = text_.find('\0'); zero != std::string::npos) {
      zero_at_ = zero;
    }
    while (at_ < text_.size() && !zero_at_) {
      copy_element();
    }
    if (!zero_at_) {
      return std::move(out_);
    }
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(*zero_at_);
    return Error{ErrorCode::invalid_input,
                 std::to_string(1 + std::count(text_.begin(), end, '\n')) +
                     ": a text with a zero byte is not allowed here"};
  }

 private:
  void copy_element() {
    const char next = text_[at_];
    if (starts_with("--")) {
      copy(2);
      copy_until(long_bracket_end().value_or(std::min(text_.find('\n', at_), text_.size())));
    } else if (const auto end = long_bracket_end()) {
      copy_until(*end);
    } else if (next == '"' || next == '\'') {
      copy_quoted(next);
    } else if (next == '#') {
      out_ += " false^";
      ++at_;
    } else {
      copy(1);
    }
  }

  void copy_quoted(char quote) {
    copy(1);
    while (at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n') {
      const bool escapes = text_[at_] == '\\';
      if (escapes && is_zero_escape()) {
        zero_at_ = at_;
      }
      const bool skips_space = starts_with("\\z");
      copy(escapes ? 2 : 1);
      while (skips_space && at_ < text_.size() &&
             std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        copy(1);
      }
    }
    copy(1);
  }

  /// \0 \00 \000 \x00 \u{0...}
  [[nodiscard]] bool is_zero_escape() const {
    const std::string_view rest = std::string_view{text_}.substr(at_ + 1);
    if (rest.substr(0, 2) == "u{") {
      return rest.find_first_not_of('0', 2) == rest.find('}');
    }
    if (rest.substr(0, 1) == "x") {
      return rest.substr(1, 2) == "00";
    }
    const std::string_view digits = rest.substr(
        0, std::min<std::size_t>(3, std::min(rest.find_first_not_of("0123456789"), rest.size())));
    return !digits.empty() && digits.find_first_not_of('0') == std::string_view::npos;
  }

  /// Where the text or comment ends that begins here with [[ or [=[ and so on.
  [[nodiscard]] std::optional<std::size_t> long_bracket_end() const {
    if (!starts_with("[")) {
      return std::nullopt;
    }
    const std::size_t second = text_.find_first_not_of('=', at_ + 1);
    if (second == std::string::npos || text_[second] != '[') {
      return std::nullopt;
    }
    const std::string closing = "]" + std::string(second - at_ - 1, '=') + "]";
    const std::size_t end = text_.find(closing, second);
    return end == std::string::npos ? text_.size() : end + closing.size();
  }

  [[nodiscard]] bool starts_with(std::string_view what) const {
    return text_.compare(at_, what.size(), what) == 0;
  }
  void copy(std::size_t size) { copy_until(std::min(at_ + size, text_.size())); }
  void copy_until(std::size_t end) {
    out_.append(text_, at_, end - at_);
    at_ = end;
  }

  const std::string& text_;
  std::string out_{};
  std::size_t at_{};
  std::optional<std::size_t> zero_at_{};
};

}  // namespace

Result<std::string> prepared_script(const std::string& text) {
  return ScriptReader{text}.prepared();
}

}  // namespace flyball
