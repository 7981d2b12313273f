// Network files: what is read is what was written, and nothing else is read.
#include "learned/network_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Imath/half.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "rpf/error.h"
#include "temporary_folder.h"
#include "test_networks.h"

namespace rpf {
namespace {

using testing::HasSubstr;

/// What parsing throws; the test fails where it does not.
std::string refusal(const std::string& bytes) {
  try {
    parse_network(bytes, "hostile.rpfnet");
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::input);
    EXPECT_THAT(e.what(), HasSubstr("hostile.rpfnet"));
    return e.what();
  }
  ADD_FAILURE() << "was read: " << bytes.substr(0, 200);
  return "";
}

std::string header_with(const std::string& from, const std::string& to) {
  std::string bytes = network_bytes(test::random_network());
  const std::size_t at = bytes.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return bytes.replace(at, from.size(), to);
}

TEST(Half, IsTheValueThatOpenExrHas) {
  for (int bits = 0; bits < 65536; ++bits) {
    Imath::half expected;
    expected.setBits(static_cast<unsigned short>(bits));
    const float value = from_half(static_cast<std::uint16_t>(bits));
    if (std::isnan(static_cast<float>(expected)))
      ASSERT_TRUE(std::isnan(value)) << bits;
    else
      ASSERT_EQ(value, static_cast<float>(expected)) << bits;
  }
  EXPECT_FALSE(std::signbit(from_half(0x8000)));
}

TEST(NetworkFile, ReadsWhatWasWritten) {
  const Network network = test::random_network({{8, {8, 12, 16}, 4, {8, 3, 1}, {5}}, 3, 1});
  const Network read = parse_network(network_bytes(network), "x");
  EXPECT_EQ(read.name, network.name);
  EXPECT_EQ(read.channels, network.channels);
  EXPECT_EQ(read.dilations, network.dilations);
  EXPECT_EQ(read.albedo_dilations, network.albedo_dilations);
  EXPECT_EQ(read.hash, network.hash);
  ASSERT_EQ(read.layers.size(), network.layers.size());
  for (std::size_t i = 0; i < read.layers.size(); ++i) {
    EXPECT_EQ(read.layers[i].weights, network.layers[i].weights) << read.layers[i].name;
    EXPECT_EQ(read.layers[i].bias, network.layers[i].bias) << read.layers[i].name;
  }
}

TEST(NetworkFile, HasALayerForEveryName) {
  const Network n = test::random_network({{8, {8, 12, 16}, 4, {8, 3, 1}, {5}}, 3, 1});
  EXPECT_EQ(n.sample1().name, "sample1");
  EXPECT_EQ(n.enter().name, "enter");
  EXPECT_EQ(n.down(0, false).name, "down0");
  EXPECT_EQ(n.down(1, false).name, "down1a");
  EXPECT_EQ(n.down(2, true).name, "down2b");
  EXPECT_EQ(n.up(1, false).name, "up1a");
  EXPECT_EQ(n.up(0, true).name, "up0b");
  EXPECT_EQ(n.head().name, "head");
  EXPECT_EQ(n.weight2().name, "weight2");
  EXPECT_EQ(n.up(1, false).inputs, 12 + 16);
  EXPECT_EQ(n.head().outputs, 8 + 1 + 4 * (4 + 1 + 10));
}

TEST(NetworkFile, IsHashedAsAWhole) {
  std::string bytes = network_bytes(test::random_network());
  const std::string hash = parse_network(bytes, "x").hash;
  bytes[bytes.size() - 2] = static_cast<char>(bytes[bytes.size() - 2] ^ 1);
  EXPECT_NE(parse_network(bytes, "x").hash, hash);
}

TEST(NetworkFile, CutAnywhereIsRefused) {
  const std::string bytes = network_bytes(test::random_network({{2, {2}, 1}, 1, 1}));
  for (std::size_t length = 0; length < bytes.size(); ++length) refusal(bytes.substr(0, length));
  EXPECT_THAT(refusal(bytes + "x"), HasSubstr("bytes of weights"));
}

TEST(NetworkFile, AWeightThatIsNotFiniteIsRefusedWithItsLayer) {
  std::string bytes = network_bytes(test::random_network());
  bytes.replace(bytes.size() - 2, 2, std::string("\x00\x7c", 2));
  EXPECT_THAT(refusal(bytes), HasSubstr("weight2"));
  bytes.replace(bytes.size() - 2, 2, std::string("\x01\xfe", 2));
  EXPECT_THAT(refusal(bytes), HasSubstr("not finite"));
}

TEST(NetworkFile, AShapeThatCannotBeIsRefused) {
  EXPECT_THAT(refusal(header_with("\"sample_features\":8", "\"sample_features\":0")), HasSubstr("sample_features"));
  EXPECT_THAT(refusal(header_with("\"sample_features\":8", "\"sample_features\":1e9")), HasSubstr("sample_features"));
  EXPECT_THAT(refusal(header_with("\"embedding\":4", "\"embedding\":-4")), HasSubstr("embedding"));
  EXPECT_THAT(refusal(header_with("\"channels\":[8,12,16]", "\"channels\":[]")), HasSubstr("channels"));
  EXPECT_THAT(refusal(header_with("\"channels\":[8,12,16]", "\"channels\":[8,99999999999999]")), HasSubstr("channels"));
  EXPECT_THAT(refusal(header_with("\"channels\":[8,12,16]", "\"channels\":[8,[12],16]")), HasSubstr("channels"));
  EXPECT_THAT(refusal(header_with("\"channels\":[8,12,16]", "\"channels\":[1,1,1,1,1,1,1,1,1]")),
              HasSubstr("channels"));
  EXPECT_THAT(refusal(header_with("\"dilations\":[8,4,2,1]", "\"dilations\":[9,4,2,1]")), HasSubstr("from 1 to 8"));
  EXPECT_THAT(refusal(header_with("\"albedo_dilations\":[2,1]", "\"albedo_dilations\":[]")),
              HasSubstr("albedo_dilations"));
  EXPECT_THAT(refusal(header_with("\"dilations\":[8,4,2,1]", "\"dilations\":[8,4,2]")), HasSubstr("bytes of weights"));
  EXPECT_THAT(refusal(header_with("\"name\":\"random\"", "\"name\":7")), HasSubstr("name"));
}

TEST(NetworkFile, OfVersionOneHasThePassesOfThen) {
  const Network read = parse_network(header_with("\"version\":2", "\"version\":1"), "x");
  EXPECT_EQ(read.dilations, (std::vector<int>{8, 4, 2, 1}));
  EXPECT_EQ(read.albedo_dilations, (std::vector<int>{2, 1}));
}

TEST(NetworkFile, ANameThatIsNoLineIsRefused) {
  Network network = test::random_network();
  for (const char* name :
       {"", "a\nb", "\x1b[31m", "12345678901234567890123456789012345678901234567890123456789012345"}) {
    network.name = name;
    EXPECT_THAT(refusal(network_bytes(network)), HasSubstr("'name' must be a line"));
  }
}

TEST(NetworkFile, WhatIsNoneIsRefused) {
  EXPECT_THAT(refusal(header_with("rpf-network", "rpf-netware")), HasSubstr("not a network file"));
  EXPECT_THAT(refusal(header_with("\"version\":2", "\"version\":3")), HasSubstr("version 1 to 2"));
  refusal("");
  refusal("\n");
  refusal("[]\n");
  refusal("{\n");
  refusal(std::string(100000, '['));
  refusal(std::string(60000, '[') + "\n");
  refusal(std::string(100, '\0') + "\n");
}

TEST(FindNetwork, KnowsThoseOfTheLibraryAndFiles) {
  for (const char* name : {"fast", "balanced"}) EXPECT_EQ(find_network(name)->name, name);
  const TemporaryFolder folder;
  const std::string path = test::write_network(test::random_network(), folder.file("a.rpfnet"));
  EXPECT_EQ(find_network(path)->name, "random");
  try {
    find_network("best");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    EXPECT_THAT(e.what(), testing::AllOf(HasSubstr("'best'"), HasSubstr("balanced, fast")));
  }
}

}  // namespace
}  // namespace rpf
