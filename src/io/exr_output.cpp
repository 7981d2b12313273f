#include "io/exr_output.h"

#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <algorithm>
#include <stdexcept>

namespace rpf::io {
namespace {

template <class Value>
Value vector_value(const std::vector<float>& floats) {
  Value value;  // Imath's vectors and matrices are plain arrays of floats
  std::copy(floats.begin(), floats.end(), reinterpret_cast<float*>(&value));
  return value;
}

void insert_floats(Imf::Header& header, const std::string& name, const std::vector<float>& floats) {
  if (name == "chromaticities" && floats.size() == 8)
    return header.insert(name, Imf::ChromaticitiesAttribute(vector_value<Imf::Chromaticities>(floats)));
  switch (floats.size()) {
    case 2:
      return header.insert(name, Imf::V2fAttribute(vector_value<Imath::V2f>(floats)));
    case 3:
      return header.insert(name, Imf::V3fAttribute(vector_value<Imath::V3f>(floats)));
    case 9:
      return header.insert(name, Imf::M33fAttribute(vector_value<Imath::M33f>(floats)));
    case 16:
      return header.insert(name, Imf::M44fAttribute(vector_value<Imath::M44f>(floats)));
    default:
      return header.insert(name, Imf::FloatVectorAttribute(floats));
  }
}

}  // namespace

void WriterStream::write(const char* bytes, int count) {
  if (!writer_.write(bytes, static_cast<std::size_t>(count))) throw std::runtime_error("write failed");
}

void insert_attribute(Imf::Header& header, const std::string& name, const Attribute& value) {
  if (const auto* number = std::get_if<std::int32_t>(&value)) header.insert(name, Imf::IntAttribute(*number));
  if (const auto* real = std::get_if<float>(&value)) header.insert(name, Imf::FloatAttribute(*real));
  if (const auto* text = std::get_if<std::string>(&value)) header.insert(name, Imf::StringAttribute(*text));
  if (const auto* floats = std::get_if<std::vector<float>>(&value)) insert_floats(header, name, *floats);
}

Imath::Box2i box_of(const Window& window) {
  return {Imath::V2i(window.x, window.y), Imath::V2i(window.x + window.width - 1, window.y + window.height - 1)};
}

}  // namespace rpf::io
