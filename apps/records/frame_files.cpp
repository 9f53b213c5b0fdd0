// SPDX-License-Identifier: BSD-3-Clause
#include "records/frame_files.h"

#include "flyball/records/pictures.h"
#include "flyball/records/report.h"
#include "flyball/records/text_table.h"

#include <algorithm>
#include <cstdint>

namespace flyball {

std::string base64_of(std::string_view content) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < content.size(); at += 3) {
    const std::size_t bytes = std::min<std::size_t>(3, content.size() - at);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      bits = (bits << 8U) | (i < bytes ? static_cast<unsigned char>(content[at + i]) : 0U);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      text += i <= bytes ? digits[(bits >> (18U - 6U * i)) & 63U] : '=';
    }
  }
  return text;
}

MissionFrame boxed(ColourImage image, const ImageBox& box, bool is_right, std::string caption) {
  constexpr Rgb right{40, 220, 40};
  constexpr Rgb wrong{255, 40, 40};
  draw_box(image, box, is_right ? right : wrong);
  return {std::move(caption), std::move(image)};
}

Result<std::string> write_frames(const std::string& folder,
                                 const std::vector<MissionFrame>& frames) {
  std::string html;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto png = png_of(frames[i].image);
    if (!png) {
      return png.error();
    }
    const std::string file = folder + "/frame_" + std::to_string(i + 1) + ".png";
    if (const Status written = write_file(file, *png); !written) {
      return written.error();
    }
    html += "<figure style=\"display:inline-block\"><img alt=\"\" src=\"data:image/png;base64," +
            base64_of(*png) + "\"><figcaption>" + html_text(frames[i].caption) +
            "</figcaption></figure>\n";
  }
  return html;
}

}  // namespace flyball
