#include "rpf/samples.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <limits>

#include "arrays.h"
#include "bindings.h"
#include "rpf/error.h"
#include "rpf/io.h"

namespace rpf::python {

using namespace nb::literals;

const SampleBuffer& Samples::get() const {
  if (!buffer) throw Error(ErrorKind::usage, "these samples were handed over by keep=False; read them again");
  return *buffer;
}

SampleBuffer Samples::release(bool keep) {
  get();
  if (keep || buffer.use_count() > 1) return *buffer;
  SampleBuffer taken = std::move(*buffer);
  buffer.reset();
  return taken;
}

namespace {

using Counts = nb::ndarray<const std::uint32_t, nb::shape<-1, -1>, nb::c_contig, nb::device::cpu>;
using Records = nb::ndarray<const float, nb::shape<-1, -1>, nb::c_contig, nb::device::cpu>;
using Plane = nb::ndarray<const float, nb::shape<-1>, nb::device::cpu>;

/// Everything but the values, which are not set.
std::shared_ptr<SampleBuffer> make_buffer(const Counts& counts, const Origin& origin,
                                          const std::optional<WindowTuple>& display, const Metadata& metadata) {
  auto buffer = std::make_shared<SampleBuffer>();
  buffer->data_window = window_of(origin, counts.shape(0), counts.shape(1));
  buffer->display_window = display ? window_of(*display) : buffer->data_window;
  buffer->metadata = metadata;
  buffer->first_sample.reserve(counts.size() + 1);
  std::uint64_t total = 0;
  buffer->first_sample.push_back(0);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    total += counts.data()[i];
    if (total > most_samples_of_frame)
      throw Error(ErrorKind::input, "counts: more than 4294967294 samples; a frame cannot have so many");
    buffer->first_sample.push_back(static_cast<std::uint32_t>(total));
  }
  return buffer;
}

void check_length(const std::string& what, std::size_t length, std::size_t samples) {
  if (length != samples)
    throw Error(ErrorKind::input, what + " has " + std::to_string(length) + " samples, counts have " +
                                      std::to_string(samples) + "; one for each is expected");
}

void init(Samples* self, const Counts& counts, std::vector<std::string> slots, const Records& values,
          const Origin& origin, const std::optional<WindowTuple>& display, const Metadata& metadata) {
  auto buffer = make_buffer(counts, origin, display, metadata);
  check_length("values", values.shape(0), buffer->sample_count());
  if (values.shape(1) != slots.size())
    throw Error(ErrorKind::input, "values has " + std::to_string(values.shape(1)) + " columns and there are " +
                                      std::to_string(slots.size()) + " slots; one column for each slot is expected");
  buffer->layout.slots = std::move(slots);
  buffer->values.assign(values.data(), values.data() + values.size());
  buffer->validate();
  new (self) Samples{std::move(buffer)};
}

Samples from_channels(const Counts& counts, const std::vector<std::pair<std::string, Plane>>& channels,
                      const Origin& origin, const std::optional<WindowTuple>& display, const Metadata& metadata) {
  auto buffer = make_buffer(counts, origin, display, metadata);
  const std::size_t samples = buffer->sample_count();
  for (const auto& [slot, plane] : channels) {
    check_length('"' + slot + '"', plane.shape(0), samples);
    buffer->layout.slots.push_back(slot);
  }
  buffer->values.resize(samples * channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto plane = channels[c].second.view();
    for (std::size_t s = 0; s < samples; ++s) buffer->values[s * channels.size() + c] = plane(s);
  }
  buffer->validate();
  return {std::move(buffer)};
}

Samples read(const std::filesystem::path& path, const std::optional<std::vector<std::string>>& slots,
             std::uint64_t max_memory) {
  const nb::gil_scoped_release free_python;
  SampleReadOptions options;
  options.slots = slots;
  options.max_memory = max_memory;
  return {std::make_shared<SampleBuffer>(read_samples(path.string(), options))};
}

View<float> column(const Samples& self, const std::string& slot) {
  const auto place = self.get().layout.find(slot);
  if (!place) throw nb::key_error(('"' + slot + "\": these samples do not have this slot").c_str());
  const std::size_t width = self.get().layout.size();
  nb::capsule keeper(new std::shared_ptr<SampleBuffer>(self.buffer),
                     [](void* p) noexcept { delete static_cast<std::shared_ptr<SampleBuffer>*>(p); });
  return View<float>(self.get().values.data() + *place, {self.get().sample_count()}, keeper,
                     {static_cast<std::int64_t>(width)});
}

View<std::uint32_t> first_sample(const Samples& self) {
  return view(self.get().first_sample.data(), {self.get().first_sample.size()}, self.buffer);
}

View<float> values(const Samples& self) {
  return view(self.get().values.data(), {self.get().sample_count(), self.get().layout.size()}, self.buffer);
}

std::vector<std::string> conventions(const Samples& self) {
  std::vector<std::string> notes;
  for (const InputNote& note : check_conventions(self.get())) notes.push_back(note.what);
  return notes;
}

std::string text_of(const Samples& self) {
  const SampleBuffer& b = self.get();
  return "rpf.Samples(" + std::to_string(b.data_window.width) + "x" + std::to_string(b.data_window.height) +
         " pixels, " + std::to_string(b.sample_count()) + " samples of " + std::to_string(b.layout.size()) + " slots)";
}

void bind_members(nb::class_<Samples>& c) {
  c.def_prop_ro(
       "window", [](const Samples& s) { return tuple_of(s.get().data_window); },
       "x, y, width, height of the data window in pixels.")
      .def_prop_ro(
          "display_window", [](const Samples& s) { return tuple_of(s.get().display_window); },
          "x, y, width, height of the display window in pixels.")
      .def_prop_ro(
          "slots", [](const Samples& s) { return s.get().layout.slots; }, "Names of the columns of values.")
      .def_prop_ro("first_sample", &first_sample, nb::rv_policy::reference,
                   "[pixels + 1] uint32, read-only, no copy: pixel p (row by row) has the samples first_sample[p] to "
                   "first_sample[p + 1] - 1.")
      .def_prop_ro("values", &values, nb::rv_policy::reference,
                   "[samples, slots] float32, read-only, no copy. A missing value is NaN.")
      .def("__getitem__", &column, nb::rv_policy::reference, "slot"_a,
           "[samples] float32 of one slot, read-only, no copy. Raises KeyError for a slot that is not there.")
      .def("__len__", [](const Samples& s) { return s.get().sample_count(); })
      .def("__repr__", &text_of)
      .def_prop_ro(
          "metadata", [](const Samples& s) { return s.get().metadata; },
          "A copy of the named values that travel from file to file: int, float, str or list of float.")
      .def("check", &conventions,
           "What in the values contradicts docs/file-format.md, each a sentence with what to do; empty where nothing "
           "does.");
}

}  // namespace

void bind_samples(nb::module_& module) {
  auto c = nb::class_<Samples>(
      module, "Samples",
      "All Monte Carlo samples of a frame: one record of float32 a sample, a column a slot (docs/file-format.md).\n\n"
      "counts: [height, width] uint32, samples of each pixel. slots: names of the columns; R, G, B, film.X and film.Y\n"
      "are required. values: [samples, slots] float32, pixel by pixel from the top left, copied once. origin: x, y of\n"
      "the first pixel. display_window: x, y, width, height; the data window if left out. metadata: name -> int, "
      "float,\n"
      "str or list of float. Raises InputError that names what does not fit.");
  c.def("__init__", &init, "counts"_a, "slots"_a, "values"_a, nb::kw_only(), "origin"_a = Origin(0, 0),
        "display_window"_a = nb::none(), "metadata"_a = Metadata{});
  c.def_static(
      "from_channels",
      [](const Counts& counts, const nb::dict& channels, const Origin& origin,
         const std::optional<WindowTuple>& display, const Metadata& metadata) {
        std::vector<std::pair<std::string, Plane>> planes;
        for (const auto& [slot, plane] : channels)
          planes.emplace_back(nb::cast<std::string>(slot), nb::cast<Plane>(plane));
        return from_channels(counts, planes, origin, display, metadata);
      },
      "counts"_a, "channels"_a, nb::kw_only(), "origin"_a = Origin(0, 0), "display_window"_a = nb::none(),
      "metadata"_a = Metadata{},
      "As Samples(), of one array for each slot: slot -> [samples] float32, copied once, with any stride.");
  bind_members(c);
  module.def(
      "read", &read, "path"_a, nb::kw_only(), "slots"_a = nb::none(), "max_memory"_a = 0,
      "Reads samples: deep OpenEXR or a raw sample file; the content decides. slots: those wanted, of those that "
      "the file has; all if left out. max_memory: bytes that may be taken, 0: no limit. Raises InputError, "
      "MemoryLimitError.");
  module.def(
      "write",
      [](const std::filesystem::path& path, const Samples& samples) {
        samples.get();
        const nb::gil_scoped_release free_python;
        write_samples(path.string(), samples.get(), samples.get().half_slots);
      },
      "path"_a, "samples"_a,
      "Writes samples (.exr: deep OpenEXR, .rpf: raw floats) or an image (the ending chooses the format). The file is "
      "there as a whole or not at all. Raises OutputError.");
}

}  // namespace rpf::python
