// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/pgm_reader.h"

#include "autopilot/pgm_bytes.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Status read(PgmReader& reader, const std::string& bytes) {
  return reader.read(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

TEST(PgmReader, reads_an_image_whatever_pieces_it_comes_in) {
  const std::string bytes = kit::pgm_bytes(3, 2, {1, 256, 65535, 0, 7, 40000});
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
    PgmReader reader;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      EXPECT_FALSE(reader.take());
      ASSERT_TRUE(read(reader, bytes.substr(at, piece)));
    }
    const auto image = reader.take();
    ASSERT_TRUE(image) << piece;
    EXPECT_EQ(image->width_px, 3);
    EXPECT_EQ(image->height_px, 2);
    EXPECT_EQ(image->values, (std::vector<std::uint16_t>{1, 256, 65535, 0, 7, 40000}));
    EXPECT_FALSE(reader.take());
  }
}

TEST(PgmReader, keeps_the_newest_of_several_and_the_beginning_of_the_next) {
  PgmReader reader;
  const std::string third = kit::pgm_bytes(1, 1, {30});
  ASSERT_TRUE(
      read(reader, kit::pgm_bytes(1, 1, {10}) + kit::pgm_bytes(1, 1, {20}) + third.substr(0, 7)));
  EXPECT_EQ(reader.take()->values.front(), 20);
  ASSERT_TRUE(read(reader, third.substr(7)));
  EXPECT_EQ(reader.take()->values.front(), 30);
}

TEST(PgmReader, reads_comments_and_a_value_that_looks_like_a_blank) {
  PgmReader reader;
  ASSERT_TRUE(read(reader, std::string{"P5 # depth\n# mm\n 1\t1\n65535\n"} + "\n "));
  EXPECT_EQ(reader.take()->values.front(), 0x0a20);
}

TEST(PgmReader, refuses_what_is_no_such_image) {
  for (const auto& [bytes, why] : {std::pair{std::string{"\x01\x02"}, "begins with byte 1"},
                                   std::pair{std::string{"P2 4 4 65535 "}, "\"P2 4 4\""},
                                   std::pair{std::string{"P5 4 4 255 "}, "8 bits"},
                                   std::pair{std::string{"P5 0 4 65535 "}, "\"P5 0 4\""},
                                   std::pair{std::string{"P5 99999 4 65535 "}, "99999"},
                                   std::pair{std::string{"P5 4x 4 65535 "}, "4x"},
                                   std::pair{"P5 " + std::string(2000, '4'), "does not end"}}) {
    PgmReader reader;
    const Status status = read(reader, bytes);
    ASSERT_FALSE(status) << bytes;
    EXPECT_NE(status.error().message.find(why), std::string::npos) << status.error().message;
  }
}

}  // namespace
}  // namespace flyball
