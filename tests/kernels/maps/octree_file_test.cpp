// SPDX-License-Identifier: BSD-3-Clause
#include "maps/octree_file.h"

#include "flyball/runtime/random.h"

#include "scratch_folder.h"
#include <sstream>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Rooms of 2 x 2 x 2 cells and single walls around the origin, both sides of it.
std::unique_ptr<octomap::OcTree> small_tree() {
  auto tree = std::make_unique<octomap::OcTree>(0.15);
  RandomStream random{7, "octree_file_test"};
  for (int i = 0; i < 400; ++i) {
    const auto key = [&] { return static_cast<octomap::key_type>(32752 + random.next() % 32); };
    const octomap::OcTreeKey at{key(), key(), key()};
    tree->updateNode(at, random.next() % 3 == 0);
  }
  return tree;
}

std::string stream_of(octomap::OcTree tree) {
  std::ostringstream stream;
  EXPECT_TRUE(tree.writeBinary(stream));
  return stream.str();
}

std::string fault_of(const std::string& content) {
  const ScratchFolder scratch;
  const auto tree = read_octree(scratch.file("broken.bt", content));
  return tree ? "" : tree.error().message;
}

std::string with_header(const std::string& tree_bytes, int nodes) {
  return "# Octomap OcTree binary file\nid OcTree\nsize " + std::to_string(nodes) +
         "\nres 0.15\ndata\n" + tree_bytes;
}

TEST(OctreeFile, what_is_written_reads_back_the_same) {
  const ScratchFolder scratch;
  const auto tree = small_tree();
  for (const char* name : {"map.ot", "map.bt"}) {  // .bt rounds the tree: last
    ASSERT_TRUE(write_octree(*tree, scratch.path(name)).ok());
    const auto again = read_octree(scratch.path(name));
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_TRUE(**again == *tree) << name;
  }
}

TEST(OctreeFile, what_octomap_wrote_itself_is_read) {
  const auto tree = small_tree();
  const ScratchFolder scratch;
  ASSERT_TRUE(tree->write(scratch.path("stock.ot")));
  ASSERT_TRUE(tree->writeBinary(scratch.path("stock.bt")));
  for (const char* name : {"stock.ot", "stock.bt"}) {
    const auto read = read_octree(scratch.path(name));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ((*read)->size(), (*read)->calcNumNodes());
    EXPECT_EQ(stream_of(**read), stream_of(*tree)) << name;
  }
}

TEST(OctreeFile, an_empty_map_is_a_map) {
  const ScratchFolder scratch;
  octomap::OcTree nothing{0.3};
  for (const char* name : {"empty.ot", "empty.bt"}) {
    ASSERT_TRUE(write_octree(nothing, scratch.path(name)).ok());
    const auto read = read_octree(scratch.path(name));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ((*read)->size(), 0U);
    EXPECT_EQ((*read)->getResolution(), 0.3);
  }
}

TEST(OctreeFile, what_is_wrong_is_said_in_one_sentence) {
  EXPECT_NE(fault_of("").find("does not begin as an OctoMap file"), std::string::npos);
  EXPECT_NE(fault_of("# Octomap OcTree binary file\nid OcTree\n").find("ends before its data"),
            std::string::npos);
  EXPECT_NE(fault_of("# Octomap OcTree binary file\nid ColorOcTree\ndata\n").find("another kind"),
            std::string::npos);
  EXPECT_NE(fault_of("# Octomap OcTree binary file\nid OcTree\nsize many\ndata\n").find("\"size\""),
            std::string::npos);
  EXPECT_NE(fault_of("# Octomap OcTree binary file\nid OcTree\nres -1\ndata\n").find("0.01"),
            std::string::npos);
  EXPECT_NE(fault_of(with_header("\x01", 2)).find("ends within its tree"), std::string::npos);
  EXPECT_NE(fault_of(with_header(std::string(2, '\0'), 1)).find("without children"),
            std::string::npos);
  EXPECT_NE(fault_of(with_header({'\x01', '\0'}, 5)).find("has 2 nodes and says 5"),
            std::string::npos);
  EXPECT_NE(fault_of(with_header({'\x01', '\0', 'x'}, 2)).find("1 bytes after its tree"),
            std::string::npos);
  std::string deep;
  for (int level = 0; level < 17; ++level) {
    deep += {'\x03', '\0'};
  }
  EXPECT_NE(fault_of(with_header(deep, 18)).find("over 16 levels"), std::string::npos);
  const auto missing = read_octree("no/such/map.bt");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  const ScratchFolder scratch;
  std::filesystem::create_symlink("loop.bt", scratch.path("loop.bt"));  // Root, too, may not.
  const auto barred = read_octree(scratch.path("loop.bt"));
  ASSERT_FALSE(barred.ok());
  EXPECT_EQ(barred.error().message, "cannot read map file \"" + scratch.path("loop.bt") +
                                        "\": Too many levels of symbolic links");
}

TEST(OctreeFile, an_ending_that_is_no_map_is_refused_and_nothing_is_left) {
  const ScratchFolder scratch;
  const auto tree = small_tree();
  EXPECT_FALSE(write_octree(*tree, scratch.path("map.txt")).ok());
  const auto unwritten = write_octree(*tree, scratch.path("missing/map.bt"));
  ASSERT_FALSE(unwritten.ok());
  EXPECT_EQ(unwritten.error().message, "cannot write map file \"" + scratch.path("missing/map.bt") +
                                           "\": No such file or directory");
  EXPECT_TRUE(scratch.is_empty());
}

/// Flips, cuts, repeats and overwrites. Every answer is right but a crash: a mutation may well be
/// another legal map.
std::string mutated(std::string content, RandomStream& random) {
  for (std::uint64_t i = 0; i <= random.next() % 4; ++i) {
    const std::size_t at = random.next() % content.size();
    switch (random.next() % 5) {
      case 0:
        content[at] = static_cast<char>(content[at] ^ 1 << random.next() % 8);
        break;
      case 1:
        content.resize(at + 1);
        break;
      case 2:
        content[at] = static_cast<char>(random.next());
        break;
      case 3:
        content.insert(at, content.substr(at, random.next() % 64));
        break;
      default:
        content.replace(at, 8, std::string(8, static_cast<char>(random.next() % 2 * 0xff)));
    }
  }
  return content;
}

TEST(OctreeFile, no_mutation_of_a_file_crashes_its_reader) {
  const ScratchFolder scratch;
  const auto tree = small_tree();
  RandomStream random{1, "octree_file_fuzz"};
  for (const char* name : {"map.ot", "map.bt"}) {
    ASSERT_TRUE(write_octree(*tree, scratch.path(name)).ok());
    const std::string content = scratch.content(name);
    int refused = 0;
    int read = 0;
    for (int i = 0; i < 500; ++i) {
      const auto result = read_octree(scratch.file("mutant", mutated(content, random)));
      if (result.ok()) {
        ++read;
        EXPECT_LE((*result)->getTreeDepth(), 16U);
        EXPECT_EQ((*result)->size(), (*result)->calcNumNodes());
      } else {
        ++refused;
        EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
      }
    }
    EXPECT_GT(refused, 150) << name;
    EXPECT_GT(read, 0) << name;
  }
}

TEST(OctreeFile, no_random_bytes_after_a_good_header_crash_its_reader) {
  const ScratchFolder scratch;
  RandomStream random{2, "octree_file_fuzz"};
  for (int i = 0; i < 500; ++i) {
    std::string bytes;
    for (std::uint64_t n = random.next() % 200; n > 0; --n) {
      bytes += static_cast<char>(random.next());
    }
    const auto nodes = static_cast<int>(random.next() % 100);
    EXPECT_FALSE(read_octree(scratch.file("noise", with_header(bytes, nodes))).ok() && nodes > 90);
  }
}

}  // namespace
}  // namespace flyball
