#include "io/exr_header.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <array>
#include <stdexcept>

#include "io/attributes.h"
#include "io/guard.h"

namespace rpf::io {
namespace {

// In the order of Imf::Compression.
std::string compression_name(Imf::Compression compression) {
  static const std::array<const char*, 10> names = {"none",  "rle", "zips", "zip",  "piz",
                                                    "pxr24", "b44", "b44a", "dwaa", "dwab"};
  const auto index = static_cast<std::size_t>(compression);
  return index < names.size() ? names[index] : "unknown";
}

PixelType pixel_type(Imf::PixelType type, const char* channel) {
  switch (type) {
    case Imf::HALF:
      return PixelType::half_float;
    case Imf::FLOAT:
      return PixelType::full_float;
    case Imf::UINT:
      return PixelType::unsigned_int;
    default:
      throw std::runtime_error(fmt::format("channel {} has an unknown type", channel));
  }
}

// OpenEXR includes the last pixel.
Corners corners(const Imath::Box2i& box) { return {box.min.x, box.min.y, box.max.x, box.max.y}; }

// Attributes of one vector or matrix type: their components in memory order.
template <class Typed>
bool take_floats(const Imf::Attribute& attribute, const std::string& name, std::size_t count, Metadata& metadata) {
  const auto* typed = dynamic_cast<const Typed*>(&attribute);
  if (typed == nullptr) return false;
  const auto* first = reinterpret_cast<const float*>(&typed->value());
  metadata[name] = std::vector<float>(first, first + count);
  return true;
}

template <class Typed>
bool take_value(const Imf::Attribute& attribute, const std::string& name, Metadata& metadata) {
  const auto* typed = dynamic_cast<const Typed*>(&attribute);
  if (typed != nullptr) metadata[name] = typed->value();
  return typed != nullptr;
}

// Returns false for types that rpf::Attribute cannot hold (boxes, time codes, ...).
bool take_attribute(const Imf::Attribute& attribute, const std::string& name, Metadata& metadata) {
  return take_value<Imf::IntAttribute>(attribute, name, metadata) ||
         take_value<Imf::FloatAttribute>(attribute, name, metadata) ||
         take_value<Imf::StringAttribute>(attribute, name, metadata) ||
         take_value<Imf::FloatVectorAttribute>(attribute, name, metadata) ||
         take_floats<Imf::V2fAttribute>(attribute, name, 2, metadata) ||
         take_floats<Imf::V3fAttribute>(attribute, name, 3, metadata) ||
         take_floats<Imf::ChromaticitiesAttribute>(attribute, name, 8, metadata) ||
         take_floats<Imf::M33fAttribute>(attribute, name, 9, metadata) ||
         take_floats<Imf::M44fAttribute>(attribute, name, 16, metadata);
}

template <class Typed>
std::optional<double> number_in(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Typed>(name);
  if (attribute == nullptr) return std::nullopt;
  return static_cast<double>(attribute->value());
}

// A number of any type: Python writes all of them as floats.
std::optional<double> number_of(const Imf::Header& header, const char* name) {
  if (const auto number = number_in<Imf::IntAttribute>(header, name)) return number;
  if (const auto number = number_in<Imf::FloatAttribute>(header, name)) return number;
  return number_in<Imf::DoubleAttribute>(header, name);
}

DeepHeader to_plain(const Imf::Header& header) {
  DeepHeader plain;
  plain.data = corners(header.dataWindow());
  plain.display = corners(header.displayWindow());
  plain.compression = compression_name(header.compression());
  if (header.hasChunkCount()) plain.chunk_count = header.chunkCount();
  const Imf::ChannelList& channels = header.channels();
  for (auto c = channels.begin(); c != channels.end(); ++c)
    plain.channels.push_back(
        {c.name(), pixel_type(c.channel().type, c.name()), c.channel().xSampling, c.channel().ySampling});
  if (const auto* format = header.findTypedAttribute<Imf::StringAttribute>(format_attribute))
    plain.format = format->value();
  plain.version = number_of(header, version_attribute);
  for (auto a = header.begin(); a != header.end(); ++a)
    if (!is_structural(a.name()) && !take_attribute(a.attribute(), a.name(), plain.metadata))
      plain.dropped.push_back(printable(fmt::format("{} ({})", a.name(), a.attribute().typeName())));
  return plain;
}

}  // namespace

DeepHeader read_header(const std::string& path, std::uint64_t header_end) {
  return guard_input(path, [&] {
    Imf::StdIFStream stream(path.c_str());
    stream.seekg(8);  // behind magic number and version, which check_structure() read
    Imf::Header header;
    int version = 2;  // of the format
    header.readFrom(stream, version);
    // Our walk and OpenEXR's must agree, or the checks were made on other attributes than those in use.
    if (stream.tellg() != header_end) throw std::runtime_error("its header attributes do not fit together");
    return to_plain(header);
  });
}

}  // namespace rpf::io
