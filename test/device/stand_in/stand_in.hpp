// Gets at the controls of a library that stands in for a maker's.
#pragma once

#include <dlfcn.h>

#include <stdexcept>

namespace feeler_test {

/// The controls, as new. Loading is what the driver does too, so both get the same library.
/// @tparam Controls  that this library exports by the function `feeler_stand_in`
template <class Controls>
Controls& stand_in(const char* library) {
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_GLOBAL | RTLD_NODELETE);
  if (handle == nullptr) throw std::runtime_error(dlerror());
  auto* const controls_of = reinterpret_cast<Controls* (*)()>(dlsym(handle, "feeler_stand_in"));
  if (controls_of == nullptr) throw std::runtime_error(dlerror());
  Controls& controls = *controls_of();
  controls.reset();
  return controls;
}

}  // namespace feeler_test
