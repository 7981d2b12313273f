// Images: linear float in EXR, sRGB bytes in PNG, and what happens to everything beside the pixels.
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfTimeCodeAttribute.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "deep_files.h"
#include "rpf/io.h"
#include "temporary_folder.h"

namespace {

using namespace deep_files;
using rpf::ErrorKind;
using rpf::Image;

Image make_image(const rpf::Window& window, const std::vector<std::string>& channels) {
  Image image;
  image.data_window = image.display_window = window;
  image.channels = channels;
  for (std::size_t i = 0; i < window.pixel_count() * channels.size(); ++i)
    image.pixels.push_back(static_cast<float>(i) * 0.37F - 2.0F);
  return image;
}

std::size_t column_of(const Image& image, const std::string& channel) {
  const auto found = std::find(image.channels.begin(), image.channels.end(), channel);
  EXPECT_NE(found, image.channels.end()) << channel;
  return static_cast<std::size_t>(found - image.channels.begin());
}

// The stored bytes, without any conversion.
std::vector<std::uint8_t> stored_bytes(const std::string& path) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path, &config);
  EXPECT_TRUE(input) << OIIO::geterror();
  std::vector<std::uint8_t> bytes(input->spec().image_bytes());
  EXPECT_TRUE(input->read_image(0, 0, 0, input->spec().nchannels, OIIO::TypeUInt8, bytes.data()));
  return bytes;
}

// IEC 61966-2-1, written again on purpose.
int srgb_byte(double linear) {
  const double c = std::min(std::max(linear, 0.0), 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return static_cast<int>(std::floor(255.0 * encoded + 0.5));
}

TEST(ImageIo, ExrKeepsEveryBitWindowAndChannel) {
  const TemporaryFolder folder;
  Image image = make_image({-7, -3, 9, 5}, {"R", "G", "B", "A", "albedo.R", "feature.N.X"});
  image.display_window = {1, 2, 20, 10};
  image.pixels[3] = std::numeric_limits<float>::quiet_NaN();
  image.pixels[8] = -std::numeric_limits<float>::infinity();
  image.pixels[9] = 1e-42F;
  rpf::write_image(folder.file("a.exr"), image);
  const Image back = rpf::read_image(folder.file("a.exr"));
  EXPECT_EQ(back.data_window, image.data_window);
  EXPECT_EQ(back.display_window, image.display_window);
  ASSERT_EQ(back.channel_count(), image.channel_count());
  for (std::size_t c = 0; c < image.channel_count(); ++c)
    for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p)
      ASSERT_EQ(std::memcmp(back.pixel(p) + column_of(back, image.channels[c]), image.pixel(p) + c, 4), 0);
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(ImageIo, ExrKeepsMetadata) {
  const TemporaryFolder folder;
  Image image = make_image({0, 0, 2, 2}, {"R", "G", "B"});
  image.metadata = {{"rpf:seed", -5},
                    {"rpf:worldOrigin", std::vector<float>{1, 2, 3}},
                    {"rpf:noise", 0.5F},
                    {"rpf:arguments", std::string("rpf a.exr -o \xC3\xA4.exr")},
                    {"comments", std::string("by hand")},
                    {"owner", std::string("nobody")},
                    {"pixelAspectRatio", 1.5F},
                    {"worldToCamera", std::vector<float>(16, 2)},
                    {"chromaticities", std::vector<float>(8, 0.25F)}};
  rpf::write_image(folder.file("a.exr"), image);
  const Image back = rpf::read_image(folder.file("a.exr"));
  for (const auto& [name, attribute] : image.metadata) {
    ASSERT_EQ(back.metadata.count(name), 1U) << name;
    EXPECT_EQ(back.metadata.at(name), attribute) << name;
  }
  EXPECT_EQ(back.metadata.count("compression"), 0U);
}

// A raw sample file's metadata may give a name of OpenEXR's another type; that must not cost the picture.
TEST(ImageIo, ExrKeepsItsOwnAttributesWhereMetadataHasAnotherType) {
  const TemporaryFolder folder;
  Image image = make_image({0, 0, 2, 2}, {"R", "G", "B"});
  image.metadata = {{"pixelAspectRatio", std::string("wide")}, {"rpf:seed", 7}};
  rpf::write_image(folder.file("a.exr"), image);
  const Image back = rpf::read_image(folder.file("a.exr"));
  EXPECT_EQ(back.metadata.at("pixelAspectRatio"), rpf::Attribute(1.0F));
  EXPECT_EQ(back.metadata.at("rpf:seed"), rpf::Attribute(7));
}

TEST(ImageIo, PngIsTheSrgbCurveOfARamp) {
  const TemporaryFolder folder;
  Image image = make_image({0, 0, 1000, 1}, {"R", "G", "B"});
  for (std::size_t p = 0; p < 1000; ++p) {
    image.pixel(p)[0] = static_cast<float>(p) / 999.0F;
    image.pixel(p)[1] = static_cast<float>(p) / 999.0F * 0.01F;  // the straight part
    image.pixel(p)[2] = static_cast<float>(p) / 250.0F - 1.0F;   // clamped on both sides
  }
  rpf::write_image(folder.file("a.png"), image);
  const std::vector<std::uint8_t> bytes = stored_bytes(folder.file("a.png"));
  ASSERT_EQ(bytes.size(), image.pixels.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], srgb_byte(image.pixels[i])) << i;
}

TEST(ImageIo, ValuesThatAreNoColors) {
  const TemporaryFolder folder;
  Image image = make_image({0, 0, 1, 1}, {"R", "G", "B"});
  image.pixels = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                  -std::numeric_limits<float>::infinity()};
  rpf::write_image(folder.file("a.png"), image);
  EXPECT_EQ(stored_bytes(folder.file("a.png")), (std::vector<std::uint8_t>{0, 255, 0}));
}

TEST(ImageIo, PngStoresColorsThatAreNotMultipliedByAlpha) {
  const TemporaryFolder folder;
  Image image = make_image({0, 0, 2, 1}, {"R", "G", "B", "A", "albedo.R"});
  image.pixels = {0.25F, 0.125F, 0, 0.5F, 9, 0.2F, 0.3F, 0.4F, 0, 9};
  rpf::write_image(folder.file("a.png"), image);
  const std::vector<std::uint8_t> expected = {static_cast<std::uint8_t>(srgb_byte(0.5)),
                                              static_cast<std::uint8_t>(srgb_byte(0.25)),
                                              0,
                                              128,
                                              static_cast<std::uint8_t>(srgb_byte(static_cast<double>(0.2F))),
                                              static_cast<std::uint8_t>(srgb_byte(static_cast<double>(0.3F))),
                                              static_cast<std::uint8_t>(srgb_byte(static_cast<double>(0.4F))),
                                              0};
  EXPECT_EQ(stored_bytes(folder.file("a.png")), expected);
  const Image back = rpf::read_image(folder.file("a.png"));
  EXPECT_NEAR(back.pixel(0)[0], 0.25F, 0.01F);
  EXPECT_NEAR(back.pixel(0)[1], 0.125F, 0.01F);
}

TEST(ImageIo, EightBitImagesAreReadAsLinearLight) {
  const TemporaryFolder folder;
  Image image = make_image({0, 0, 64, 1}, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i) / 191.0F;
  for (const char* name : {"a.png", "a.bmp", "a.tga", "a.ppm", "A.PNG"}) {
    rpf::write_image(folder.file(name), image);
    const Image back = rpf::read_image(folder.file(name));
    ASSERT_EQ(back.pixels.size(), image.pixels.size()) << name;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) ASSERT_NEAR(back.pixels[i], image.pixels[i], 0.005) << name;
  }
}

TEST(ImageIo, EveryFormatComesBackAndIsTheSameFileTwice) {
  const TemporaryFolder folder;
  const Image image = make_image({3, 4, 33, 21}, {"albedo.R", "A", "B", "G", "R"});
  for (const char* name : {"a.exr", "a.tif", "a.tiff", "a.hdr", "a.rgbe", "a.png", "a.jpg", "a.jpeg", "a.bmp", "a.tga",
                           "a.gif", "a.webp", "a.ppm", "a.pnm"}) {
    rpf::write_image(folder.file(name), image);
    const std::string first = file_bytes(folder.file(name));
    const Image back = rpf::read_image(folder.file(name));
    EXPECT_EQ(back.data_window.width, 33) << name;
    EXPECT_EQ(back.data_window.height, 21) << name;
    EXPECT_GE(back.channel_count(), 3U) << name;
    rpf::write_image(folder.file(name), image);
    EXPECT_EQ(file_bytes(folder.file(name)), first) << name;
  }
}

// OpenImageIO would add the time of writing, and equal images would be different files.
TEST(ImageIo, NoTimeOfWritingInTheFile) {
  const TemporaryFolder folder;
  rpf::write_image(folder.file("a.exr"), make_image({0, 0, 2, 2}, {"R", "G", "B"}));
  const auto input = OIIO::ImageInput::open(folder.file("a.exr"));
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().get_string_attribute("DateTime"), "");
}

TEST(ImageIo, FloatFormatsKeepRadianceAboveOne) {
  const TemporaryFolder folder;
  Image image = make_image({0, 0, 2, 1}, {"X", "B", "G", "R"});
  image.pixels = {9, 3, 2, 1, 9, 40, 20, 10};
  for (const char* name : {"a.exr", "a.tif", "a.hdr"}) {
    rpf::write_image(folder.file(name), image);
    const Image back = rpf::read_image(folder.file(name));
    const std::size_t red = std::string(name) == "a.tif" ? 3 : column_of(back, "R");  // TIFF has no channel names
    EXPECT_NEAR(back.pixel(1)[red], 10, 0.1) << name;
  }
}

TEST(ImageIo, OutputsThatCannotBe) {
  const TemporaryFolder folder;
  const Image image = make_image({0, 0, 2, 2}, {"R", "G", "B"});
  const auto error_for = [&](const std::string& path, const Image& content) {
    return error_of([&] { rpf::write_image(path, content); });
  };
  for (const char* name : {"a.xyz", "a", "a.term", "a.null", ".png"})
    expect_error(error_for(folder.file(name), image), ErrorKind::output, {name, ".exr", ".png", ".hdr"});
  expect_error(error_for(folder.file("a.png"), make_image({0, 0, 2, 2}, {"R", "B"})), ErrorKind::output,
               {"a.png", "no G", ".exr"});
  expect_error(error_for(folder.file("missing/a.png"), image), ErrorKind::output, {"missing/a.png"});
  for (const char* device : {"/dev/full", "/dev/null"})
    expect_error(error_for(device, image), ErrorKind::output, {device, "a device"});
  expect_error(error_for(folder.path(), image), ErrorKind::output, {"a folder"});
  std::filesystem::create_directory(folder.file("a.exr"));
  expect_error(error_for(folder.file("a.exr"), image), ErrorKind::output, {"a.exr", "a folder"});
  EXPECT_EQ(folder.entry_count(), 1U);
}

// The library that reads images would be asked for parts; OpenEXR writes them here.
TEST(ImageIo, SeveralImagesInOneFileAreRefused) {
  const TemporaryFolder folder;
  std::vector<Imf::Header> headers(2, Imf::Header(4, 4));
  for (Imf::Header& header : headers) header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  headers[0].setName("right");
  headers[1].setName("left");
  for (Imf::Header& header : headers) header.setType(Imf::SCANLINEIMAGE);
  const std::vector<float> pixels(16, 0.5F);
  {
    Imf::MultiPartOutputFile file(folder.file("parts.exr").c_str(), headers.data(), 2);
    for (int number = 0; number < 2; ++number) {
      Imf::OutputPart part(file, number);
      Imf::FrameBuffer frame;
      frame.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(pixels.data())), 4, 16));
      part.setFrameBuffer(frame);
      part.writePixels(4);
    }
  }
  expect_error(error_of([&] { rpf::read_image(folder.file("parts.exr")); }), ErrorKind::input,
               {"parts.exr", "2 images", "right", "left", "exrmultipart"});
  const auto pages = OIIO::ImageOutput::create(folder.file("pages.tif"));
  const OIIO::ImageSpec page(4, 4, 3, OIIO::TypeFloat);
  const std::vector<float> colors(48, 0.5F);
  for (const auto mode : {OIIO::ImageOutput::Create, OIIO::ImageOutput::AppendSubimage}) {
    ASSERT_TRUE(pages->open(folder.file("pages.tif"), page, mode));
    pages->write_image(OIIO::TypeFloat, colors.data());
  }
  pages->close();
  expect_error(error_of([&] { rpf::read_image(folder.file("pages.tif")); }), ErrorKind::input, {"pages.tif", "images"});
}

TEST(ImageIo, WhatHasNoPlaceInAnImageIsNamed) {
  const TemporaryFolder folder;
  Imf::Header header(4, 4);
  for (const char* channel : {"R", "G", "B", "left.R"}) header.channels().insert(channel, Imf::Channel(Imf::HALF));
  header.insert("timeCode", Imf::TimeCodeAttribute(Imf::TimeCode(1, 2, 3, 4)));
  header.insert("view", Imf::StringAttribute("right"));
  std::vector<half> pixels(16, half(0.5F));
  Imf::FrameBuffer frame;
  for (const char* channel : {"R", "G", "B", "left.R"})
    frame.insert(channel, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(pixels.data()), 2, 8));
  {
    Imf::OutputFile file(folder.file("a.exr").c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(4);
  }
  const Image image = rpf::read_image(folder.file("a.exr"));
  EXPECT_EQ(image.view, "right");
  EXPECT_EQ(image.half_channels.size(), 4U);
  ASSERT_EQ(image.dropped.size(), 1U);
  EXPECT_NE(image.dropped[0].find("imeCode"), std::string::npos) << image.dropped[0];
}

TEST(ImageIo, InputsThatCannotBe) {
  const TemporaryFolder folder;
  const auto error_for = [&](const std::string& name) { return error_of([&] { rpf::read_image(folder.file(name)); }); };
  expect_error(error_for("missing.png"), ErrorKind::input, {"missing.png", "No such file"});
  expect_error(error_for(""), ErrorKind::input, {"a folder"});
  write_bytes(folder.file("text.png"), "this is no picture");
  expect_error(error_for("text.png"), ErrorKind::input, {"text.png"});
  write_deep(folder.file("deep.exr"), {});
  expect_error(error_for("deep.exr"), ErrorKind::input, {"deep.exr", "deep file", "filter the samples first"});
  const Image image = make_image({0, 0, 50, 50}, {"R", "G", "B"});
  for (const char* name : {"a.exr", "a.tif"}) {  // a cut PNG is an error too, but OpenImageIO leaks on its way there
    rpf::write_image(folder.file(name), image);
    const std::string bytes = file_bytes(folder.file(name));
    for (const std::size_t size : {bytes.size() / 8, bytes.size() / 2, bytes.size() * 7 / 8}) {
      write_bytes(folder.file(name), bytes.substr(0, size));
      expect_error(error_for(name), ErrorKind::input, {name});
    }
  }
}

}  // namespace
