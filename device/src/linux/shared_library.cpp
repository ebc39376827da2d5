// Asks the dynamic linker.
#include "feeler/device/shared_library.hpp"

#include <dlfcn.h>

namespace feeler {

std::string SharedLibrary::load(const std::vector<std::string>& candidates) {
  if (is_loaded()) return {};
  std::string refusals;
  for (const std::string& candidate : candidates) {
    // Global, because some makers' libraries look for symbols of their own parts in it.
    handle_ = dlopen(candidate.c_str(), RTLD_LAZY | RTLD_GLOBAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      path_ = candidate;
      return {};
    }
    const char* const refusal = dlerror();
    if (!refusals.empty()) refusals += "; ";
    refusals += refusal != nullptr ? refusal : candidate.c_str();
  }
  return refusals.empty() ? std::string("no file name was given") : refusals;
}

void* SharedLibrary::address_of(const char* name) const noexcept { return handle_ == nullptr ? nullptr : dlsym(handle_, name); }

}  // namespace feeler
