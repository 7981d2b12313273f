// What stands behind the opaque types of rpf/rpf_c.h, and what lets no exception out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rpf/devices.h"
#include "rpf/error.h"
#include "rpf/image.h"
#include "rpf/rpf_c.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

struct rpf_settings {
  rpf::Settings value;
};

struct rpf_device_list {
  std::vector<rpf::DeviceInfo> value;
};

struct rpf_sample_buffer {
  rpf::SampleBuffer value;
};

struct rpf_image {
  rpf::Image value;
};

namespace rpf::c_api {

/// What failed in this thread last; the memory is this thread's.
std::string& error_text();

/// The status of the exception that is being handled; keeps its text.
rpf_status keep_error() noexcept;

/// Runs work() and turns what it throws into a status and a text.
template <class Work>
rpf_status guarded(const Work& work) noexcept {
  try {
    work();
    return RPF_OK;
  } catch (...) {
    return keep_error();
  }
}

/// Throws Error(usage) where a pointer that must lead somewhere is NULL. `what`: "rpf_filter: image".
void require(const void* pointer, const char* what);

}  // namespace rpf::c_api
