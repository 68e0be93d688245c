#pragma once

#include <cstddef>

// The whole test program counts at malloc, where operator new and Eigen's own allocator meet. It is
// defined here: one source of a program includes this header, and no other.

namespace reckon::testing_models {
/// Allocations of this thread since it was last set to zero.
thread_local long allocations = 0;
}  // namespace reckon::testing_models

#if defined(__SANITIZE_ADDRESS__)
// Declared here: GCC does not install the sanitizers' own header.
extern "C" int __sanitizer_install_malloc_and_free_hooks(
    void (*on_malloc)(const volatile void* memory, std::size_t size),
    void (*on_free)(const volatile void* memory));

namespace {
void OnMalloc(const volatile void* /*memory*/, std::size_t /*size*/) {
  ++reckon::testing_models::allocations;
}
void OnFree(const volatile void* /*memory*/) {}
[[maybe_unused]] const int hooks = __sanitizer_install_malloc_and_free_hooks(OnMalloc, OnFree);
}  // namespace
#else
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++reckon::testing_models::allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++reckon::testing_models::allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  ++reckon::testing_models::allocations;
  return __libc_realloc(memory, size);
}
}
#endif
