// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/detection_run.h"

#include "flyball/records/pictures.h"

#include "scratch_folder.h"
#include <filesystem>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

std::string grey_png() {
  ColourImage image;
  image.camera = {160, 160, 0.0, 0.0, 0.0};
  image.rgb.assign(3 * 160 * 160, 120);
  return *png_of(image);
}

class Detecting : public testing::Test {
 protected:
  Status detect() {
    return run_detection(run, [this](const DetectedFrame& frame) {
      frames.push_back(frame);
      return frames.size() < most;
    });
  }
  const ScratchFolder folder;
  DetectionRun run{folder.file("grey.png", grey_png())};
  std::vector<DetectedFrame> frames;
  std::size_t most{100};
};

TEST_F(Detecting, looks_at_a_picture_and_writes_it_where_it_is_asked_to) {
  run.out = folder.path("out");
  const Status done = detect();
  ASSERT_TRUE(done.ok()) << done.error().message;
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(frames[0].people.empty());
  EXPECT_GT(frames[0].work.count("windows"), 0.0);
  EXPECT_EQ(frames[0].picture, folder.path("out") + "/grey.png");
  EXPECT_EQ(folder.content("out/grey.png").substr(1, 3), "PNG");
}

TEST_F(Detecting, of_a_folder_goes_on_after_a_picture_that_cannot_be_read) {
  (void)folder.file("a.jpg", "no picture at all");
  (void)folder.file("cut.png", grey_png().substr(0, 60));
  (void)folder.file("notes.txt", "no picture, and nobody says so");
  (void)folder.file("z.png", grey_png());
  run.input = folder.path();
  run.out = folder.path("out");
  const Status done = detect();
  ASSERT_TRUE(done.ok()) << done.error().message;
  ASSERT_EQ(frames.size(), 4U);
  DetectionTotals totals;
  std::string unreadable;
  for (const DetectedFrame& frame : frames) {
    totals.add(frame);
    unreadable += frame.trouble;
  }
  EXPECT_EQ(totals.frames, 2U);
  EXPECT_EQ(totals.unreadable, 2U);
  EXPECT_NE(unreadable.find("a.jpg\" cannot be read"), std::string::npos) << unreadable;
  EXPECT_NE(unreadable.find("cut.png\" cannot be read"), std::string::npos) << unreadable;
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/cut.png")));
}

TEST_F(Detecting, gives_pictures_of_one_stem_different_names) {
  run.input = folder.path("all");
  std::filesystem::create_directory(run.input);
  for (const char* name : {"all/a.jpg", "all/a.png", "all/a_2.png"}) {
    (void)folder.file(name, grey_png());
  }
  run.out = folder.path("out");
  ASSERT_TRUE(detect().ok());
  std::set<std::string> written;
  for (const DetectedFrame& frame : frames) {
    written.insert(frame.picture);
  }
  EXPECT_EQ(written.size(), 3U);
  EXPECT_FALSE(folder.content("out/a.png").empty());
  EXPECT_FALSE(folder.content("out/a_2.png").empty());
}

TEST_F(Detecting, refuses_a_single_picture_that_cannot_be_read) {
  run.input = folder.file("cut.png", grey_png().substr(0, 60));
  const Status done = detect();
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("cut.png"), std::string::npos);
}

TEST_F(Detecting, does_not_write_over_the_pictures_that_it_reads) {
  run.out = folder.path();
  const Status done = detect();
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("would be overwritten"), std::string::npos);
  EXPECT_EQ(folder.content("grey.png"), grey_png());
  run.input = folder.path();
  EXPECT_FALSE(detect().ok());
}

TEST_F(Detecting, stops_when_nobody_wants_more) {
  (void)folder.file("other.png", grey_png());
  run.input = folder.path();
  most = 1;
  EXPECT_TRUE(detect().ok());
  EXPECT_EQ(frames.size(), 1U);
}

TEST_F(Detecting, refuses_an_unknown_detector_parameter_and_file) {
  run.detector = "owl";
  EXPECT_NE(detect().error().message.find("\"owl\""), std::string::npos);
  run.detector = "hog";
  run.parameters = {{"treshold", 0.5}};
  EXPECT_NE(detect().error().message.find("treshold"), std::string::npos);
  run.parameters = {};
  run.input = folder.path("absent.png");
  EXPECT_NE(detect().error().message.find("absent.png"), std::string::npos);
  EXPECT_TRUE(frames.empty());
}

TEST_F(Detecting, says_all_of_it_as_one_line_of_json) {
  DetectedFrame frame{"a.avi", 7, {{{1.0, 2.0, 3.0, 4.0}, 0.5}}, {}, 1.5, "", ""};
  frame.work.add("windows", 12.0);
  const std::string line = to_json(frame);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto read = nlohmann::json::parse(line);
  EXPECT_EQ(read["frame"], 7);
  EXPECT_EQ(read["people"][0]["height_px"], 4.0);
  EXPECT_EQ(read["work"]["windows"], 12.0);
}

}  // namespace
}  // namespace flyball
