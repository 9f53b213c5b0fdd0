// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/text/toml_text.h"

#include <algorithm>
#include <string>

namespace flyball {
namespace {

constexpr std::string_view blanks = " \t";
constexpr int most_parts = 16;
constexpr std::string_view marks_of_value = "\"'[{";  // Those that begin one which is not bare.

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_key_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_' || c == '-';
}

bool is_blank(char c) {
  return std::string_view{" \t\r\n\v\f"}.find(c) != std::string_view::npos;
}

/// Ends a bare value, for toml++.
bool is_terminator(char c) {
  return is_blank(c) || std::string_view{"]},#"}.find(c) != std::string_view::npos;
}

bool is_outside_of_ascii(char c) {
  return static_cast<unsigned char>(c) >= 0x80U;
}

/// Reads TOML's lexical elements as far as it takes to tell names and values from texts and
/// comments.
class TomlScan {
 public:
  explicit TomlScan(std::string_view text) : text_{text} {
    if (starts_with("\xef\xbb\xbf")) {  // A byte order mark.
      text_.remove_prefix(3);
    }
  }

  std::optional<TomlFault> fault() {
    while (at_ < text_.size() && what_.empty()) {
      look_at_element();
    }
    if (what_.empty()) {
      return std::nullopt;
    }
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
    return TomlFault{1 + static_cast<int>(std::count(text_.begin(), end, '\n')), what_};
  }

 private:
  void look_at_element() {
    const char next = text_[at_];
    if (next == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (expects_value_ && !is_terminator(next) &&
               marks_of_value.find(next) == std::string_view::npos) {
      look_at_bare_value();
    } else if (next == '"' || next == '\'') {
      look_at_quoted();
    } else if (next == '[' && open_.empty() && is_first_of_line()) {
      look_at_header();
    } else {
      look_at_character(next);
    }
  }

  void look_at_character(char next) {
    if (is_outside_of_ascii(next)) {
      what_ = "letters outside of ASCII must stand in quotes";
      return;
    }
    count_part(next);
    if (next == '[' || next == '{') {
      open_ += next;
    } else if (next == '}' && !open_.empty() && open_.back() == '[') {
      what_ = "a list ends with ] and not with }";
      return;
    } else if ((next == ']' || next == '}') && !open_.empty()) {
      open_.pop_back();
    }
    const bool is_in_list = !open_.empty() && open_.back() == '[';
    if (!is_blank(next) || (next == '\n' && open_.empty())) {
      expects_value_ = next == '=' || next == '[' || (next == ',' && is_in_list);
    }
    ++at_;
  }

  /// Each part of a name is a table in a table, and whoever walks through them does so by
  /// recursion.
  void count_part(char next) {
    if (next == '.' && ++points_ == most_parts) {
      what_ = "a name has more than " + std::to_string(most_parts) + " parts";
    } else if (next != '.' && !is_key_character(next) && blanks.find(next) == blanks.npos) {
      points_ = 0;
    }
  }

  /// A number, a date, a time, `true`, `inf`. toml++ reads on to the next blank or bracket,
  /// whatever stands before it.
  void look_at_bare_value() {
    expects_value_ = false;
    skip_bare_word();
    const bool may_have_time =
        at_ + 1 < text_.size() && text_[at_] == ' ' && is_digit(text_[at_ + 1]);
    if (what_.empty() && is_behind_date() && may_have_time) {
      const std::size_t begin = ++at_;
      skip_bare_word();
      if (at_ - begin == 1 && what_.empty()) {
        what_ = "a date is followed by a number that is no time";
      }
    }
  }

  void skip_bare_word() {
    while (at_ < text_.size() && !is_terminator(text_[at_])) {
      if (!is_key_character(text_[at_]) &&
          std::string_view{"+.:"}.find(text_[at_]) == std::string_view::npos) {
        what_ = "a value that is not quoted holds more than letters, digits and + - . _ :";
        return;
      }
      ++at_;
    }
  }

  /// Whether toml++ takes what ends here for a date: `dddd-dd-dd`, of which it looks at the first
  /// digit and at the dashes, and leaves out underscores.
  [[nodiscard]] bool is_behind_date() const {
    constexpr std::size_t length = 10;
    constexpr std::size_t year_end = 4;
    constexpr std::size_t month_end = 7;
    std::string word;  // Backwards.
    for (std::size_t i = at_; i > 0 && word.size() < length && !is_terminator(text_[i - 1]); --i) {
      if (text_[i - 1] != '_') {
        word += text_[i - 1];
      }
    }
    return word.size() == length && is_digit(word.back()) && word[length - 1 - year_end] == '-' &&
           word[length - 1 - month_end] == '-';
  }

  /// `[name]` or `[[name]]`: up to the first character of the name.
  void look_at_header() {
    ++at_;
    skip_blanks();
    if (starts_with("[")) {
      ++at_;
      skip_blanks();
    }
    const char next = at_ < text_.size() ? text_[at_] : ']';
    if (!is_key_character(next) && next != '"' && next != '\'' && next != ']') {
      what_ = "the name of a table must begin with a letter, a digit, _, - or a quotation mark";
    }
  }

  /// toml++ takes a quotation mark behind whatever is no mark of TOML's for a part of a bare value,
  /// up to the next blank.
  void look_at_quoted() {
    constexpr std::string_view quoted_stands_behind = "\r\n \t=,.[{";
    const char before = at_ == 0 ? '\n' : text_[at_ - 1];
    if (quoted_stands_behind.find(before) == std::string_view::npos) {
      what_ = "a quotation mark stands within a word";
      return;
    }
    expects_value_ = false;
    const std::size_t begin = at_;
    const bool is_long = starts_with("\"\"\"") || starts_with("'''");
    skip_quoted(text_.substr(at_, is_long ? 3 : 1), is_long);
    const std::string_view quoted = text_.substr(begin, at_ - begin);
    if (before == '.' && std::any_of(quoted.begin(), quoted.end(), is_outside_of_ascii)) {
      what_ = "letters outside of ASCII must not stand behind a point";
    }
  }

  /// To behind the quotation marks, or to where the text breaks off.
  void skip_quoted(std::string_view mark, bool goes_over_lines) {
    const bool escapes = mark.front() == '"';
    at_ += mark.size();
    while (at_ < text_.size() && !starts_with(mark)) {
      if (text_[at_] == '\n' && !goes_over_lines) {
        return;
      }
      if (escapes && text_[at_] == '\\') {
        skip_escaped(goes_over_lines);
      } else {
        ++at_;
      }
    }
    at_ = std::min(at_ + mark.size(), text_.size());
    // `"""a"""""` ends with two marks that belong to the text.
    constexpr int most_more = 2;
    for (int more = 0; goes_over_lines && more < most_more && starts_with(mark.substr(0, 1));
         ++more) {
      ++at_;
    }
  }

  /// A backslash and what it escapes. In a text of several lines these may be blanks and ends of
  /// lines; toml++ asks whether the letter behind them is one more blank.
  void skip_escaped(bool goes_over_lines) {
    const std::size_t next = text_.find_first_not_of(" \t\r\n", at_ + 1);
    if (goes_over_lines && next != std::string_view::npos && is_outside_of_ascii(text_[next])) {
      what_ = "letters outside of ASCII must not be the next ones behind a backslash";
    }
    at_ += 2;
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }
  [[nodiscard]] bool is_first_of_line() const {
    const std::size_t before =
        at_ == 0 ? std::string_view::npos : text_.find_last_not_of(blanks, at_ - 1);
    return before == std::string_view::npos || text_[before] == '\n';
  }
  [[nodiscard]] bool starts_with(std::string_view what) const {
    return text_.compare(std::min(at_, text_.size()), what.size(), what) == 0;
  }

  std::string_view text_;
  std::size_t at_{};
  std::string open_{};    ///< The brackets of lists and of tables in a line that are not closed.
  bool expects_value_{};  ///< Behind `=`, or in a list behind `[` or a comma.
  int points_{};          ///< In the name so far.
  std::string what_{};
};

}  // namespace

std::optional<TomlFault> fault_of_toml(std::string_view text) {
  return TomlScan{text}.fault();
}

}  // namespace flyball
