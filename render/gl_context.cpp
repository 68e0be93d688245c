#include "reckon/render/gl_context.h"

#include <dlfcn.h>

#include <stdexcept>
#include <vector>

namespace reckon::render {
namespace {

/// A shared library that is closed again.
class Library {
 public:
  explicit Library(const std::vector<const char*>& names) {
    for (const char* name : names) {
      if (handle_ == nullptr) handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    }
    if (handle_ == nullptr) throw std::runtime_error(std::string("no ") + names.front());
  }
  ~Library() { dlclose(handle_); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  template <class Function>
  Function* Get(const char* name) const {
    void* symbol = dlsym(handle_, name);
    if (symbol == nullptr) throw std::runtime_error(std::string("no function ") + name);
    return reinterpret_cast<Function*>(symbol);
  }

 private:
  void* handle_ = nullptr;
};

// Of the EGL registry.
constexpr int kOpenGlApi = 0x30A2, kNone = 0x3038, kSurfaceType = 0x3033, kPbufferBit = 1;
constexpr int kRenderableType = 0x3040, kOpenGlBit = 8, kPlatformSurfaceless = 0x31DD;
constexpr int kDepthSize = 0x3025;

class EglContext : public GlContext {
 public:
  EglContext() : egl_({"libEGL.so.1", "libEGL.so"}) {
    using Procedure = void();
    auto* get = egl_.Get<Procedure*(const char*)>("eglGetProcAddress");
    using PlatformDisplay = void*(unsigned, void*, const int*);
    auto* platform = reinterpret_cast<PlatformDisplay*>(get("eglGetPlatformDisplayEXT"));
    if (platform == nullptr) throw std::runtime_error("EGL knows no platforms");
    display_ = platform(kPlatformSurfaceless, nullptr, nullptr);
    int major = 0, minor = 0;
    Require(display_ != nullptr, "EGL has no surfaceless display");
    Require(egl_.Get<unsigned(void*, int*, int*)>("eglInitialize")(display_, &major, &minor) != 0,
            "EGL can't be initialised");
    Require(egl_.Get<unsigned(unsigned)>("eglBindAPI")(kOpenGlApi) != 0, "EGL has no OpenGL");
    const int wanted[] = {kSurfaceType, kPbufferBit, kRenderableType, kOpenGlBit, kDepthSize,
                          24,           kNone};
    void* config = nullptr;
    int count = 0;
    using Choose = unsigned(void*, const int*, void**, int, int*);
    egl_.Get<Choose>("eglChooseConfig")(display_, wanted, &config, 1, &count);
    Require(count > 0, "EGL has no configuration to draw with");
    using Create = void*(void*, void*, void*, const int*);
    context_ = egl_.Get<Create>("eglCreateContext")(display_, config, nullptr, nullptr);
    Require(context_ != nullptr, "EGL makes no context");
    Require(MakeCurrent(context_), "EGL's context can't be used");
  }
  ~EglContext() override { Close(); }

 private:
  bool MakeCurrent(void* context) const {
    using Make = unsigned(void*, void*, void*, void*);
    return egl_.Get<Make>("eglMakeCurrent")(display_, nullptr, nullptr, context) != 0;
  }

  void Close() {
    if (display_ == nullptr) return;
    MakeCurrent(nullptr);
    if (context_ != nullptr)
      egl_.Get<unsigned(void*, void*)>("eglDestroyContext")(display_, context_);
    egl_.Get<unsigned(void*)>("eglTerminate")(display_);
  }

  void Require(bool holds, const char* what) {
    if (holds) return;
    Close();
    throw std::runtime_error(what);
  }

  Library egl_;
  void* display_ = nullptr;
  void* context_ = nullptr;
};

class OsMesaContext : public GlContext {
 public:
  OsMesaContext(int width, int height)
      : mesa_({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}),
        pixels_(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    constexpr unsigned kRgba = 0x1908, kUnsignedByte = 0x1401;
    using Create = void*(unsigned, int, int, int, void*);
    context_ = mesa_.Get<Create>("OSMesaCreateContextExt")(kRgba, 24, 8, 8, nullptr);
    if (context_ == nullptr) throw std::runtime_error("OSMesa makes no context");
    using Make = unsigned char(void*, void*, unsigned, int, int);
    if (mesa_.Get<Make>("OSMesaMakeCurrent")(context_, pixels_.data(), kUnsignedByte, width,
                                             height) == 0) {
      mesa_.Get<void(void*)>("OSMesaDestroyContext")(context_);
      throw std::runtime_error("OSMesa's context can't be used");
    }
  }
  ~OsMesaContext() override { mesa_.Get<void(void*)>("OSMesaDestroyContext")(context_); }

 private:
  Library mesa_;
  std::vector<unsigned char> pixels_;
  void* context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> GlContext::Make(const std::string& gl, int width, int height) {
  std::string tried;
  const auto attempt = [&](const char* name, auto make) -> std::unique_ptr<GlContext> {
    if (gl != "auto" && gl != name) return nullptr;
    try {
      return make();
    } catch (const std::runtime_error& error) {
      tried += std::string(tried.empty() ? "" : "; ") + name + ": " + error.what();
      return nullptr;
    }
  };
  if (auto egl = attempt("egl", [] { return std::make_unique<EglContext>(); })) return egl;
  if (auto mesa =
          attempt("osmesa", [&] { return std::make_unique<OsMesaContext>(width, height); })) {
    return mesa;
  }
  throw std::runtime_error("nothing to draw with (" +
                           (tried.empty() ? "'" + gl + "' is not auto, egl or osmesa" : tried) +
                           ")");
}

}  // namespace reckon::render
