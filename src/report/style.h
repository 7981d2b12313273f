#pragma once

namespace rpf::report {

/// The CSS of all pages: light and dark, from 320 pixels of width up.
extern const char* const style;

}  // namespace rpf::report
