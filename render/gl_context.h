#pragma once

#include <memory>
#include <string>

namespace reckon::render {

/// An OpenGL context without a screen, current on the thread that makes it. Neither library is
/// linked: EGL (surfaceless) is tried first, then OSMesa; where no context comes of EGL it is
/// closed again before OSMesa is opened, since the two do not live in one process.
class GlContext {
 public:
  virtual ~GlContext() = default;

  /// `gl` is "auto", "egl" or "osmesa". Throws std::runtime_error, which says what was tried.
  static std::unique_ptr<GlContext> Make(const std::string& gl, int width, int height);
};

}  // namespace reckon::render
