#pragma once

#include <string>

namespace reckon::harness {

/// The JSON Schema (draft 2020-12) of scenario files, made from the same description that reads
/// them.
///
/// It judges one file on its own. What needs more than that is left to `reckon check`: a key that
/// must come from here or from an included file, and conditions between several keys.
std::string JsonSchema();

}  // namespace reckon::harness
