#pragma once

#include <functional>
#include <string>

namespace reckon::testing_sim {

/// What `action` throws, which must be an Error.
template <typename Error>
std::string Message(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

}  // namespace reckon::testing_sim
