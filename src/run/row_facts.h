// What was found in a whole frame, as text that another process can read (rpf/rows.h).
#pragma once

#include <string>
#include <variant>

#include "frame/frame_scan.h"
#include "learned/observe_scan.h"

namespace rpf {

/// Of the methods that prepare() is for, or of the learned one.
using RowFacts = std::variant<FrameFindings, ObservedFindings>;

/// JSON; every number comes back with the same bits.
std::string text_of(const RowFacts& facts);

/// Throws Error(input) for a text that is none of text_of(), or of another kind of method.
RowFacts facts_of(const std::string& text, Method method);

}  // namespace rpf
