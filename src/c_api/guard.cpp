#include <new>

#include "c_api/objects.h"
#include "rpf/version.h"

namespace rpf::c_api {

std::string& error_text() {
  static thread_local std::string text;
  return text;
}

namespace {

rpf_status keep(rpf_status status, const char* text) noexcept {
  try {
    error_text() = text;
  } catch (...) {  // no memory for a text: the status says it
    error_text().clear();
  }
  return status;
}

}  // namespace

rpf_status keep_error() noexcept {
  try {
    throw;
  } catch (const Error& e) {
    return keep(static_cast<rpf_status>(e.kind()), e.what());
  } catch (const std::bad_alloc&) {
    return keep(RPF_MEMORY, "out of memory; lower max-memory or threads, or leave channels out");
  } catch (const std::exception& e) {
    return keep(RPF_INTERNAL, e.what());
  } catch (...) {
    return keep(RPF_INTERNAL, "an unknown exception; report this defect");
  }
}

void require(const void* pointer, const char* what) {
  if (pointer == nullptr) throw Error(ErrorKind::usage, std::string(what) + " is NULL; hand over where it is");
}

}  // namespace rpf::c_api

const char* rpf_error_text(void) { return rpf::c_api::error_text().c_str(); }

const char* rpf_version_text(void) { return rpf::version(); }
