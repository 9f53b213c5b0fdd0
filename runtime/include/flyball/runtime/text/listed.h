// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Lists in messages: `rrt, rrt_connect, prm`.

#include <string>
#include <string_view>
#include <type_traits>

namespace flyball {

/// The items with ", " between them.
///
/// @param items    Any range.
/// @param text_of  The text of one item; an item whose text is empty is left out.
template <class Items, class TextOf>
[[nodiscard]] std::string listed(const Items& items, TextOf text_of) {
  std::string list;
  for (const auto& item : items) {
    const std::string text = text_of(item);
    list += (list.empty() || text.empty() ? "" : ", ") + text;
  }
  return list;
}

/// The same of texts or integers.
template <class Items>
[[nodiscard]] std::string listed(const Items& items) {
  return listed(items, [](const auto& item) {
    if constexpr (std::is_convertible_v<decltype(item), std::string_view>) {
      return std::string{std::string_view{item}};
    } else {
      static_assert(std::is_integral_v<std::decay_t<decltype(item)>>, "say how to write an item");
      return std::to_string(item);
    }
  });
}

}  // namespace flyball
