// A library of a device's maker, loaded while the program runs: Feeler is built and starts without it.
#pragma once

#include <string>
#include <vector>

namespace feeler {

/// A shared library by dlopen, and its functions by dlsym.
///
/// It stays loaded until the program ends: drivers of devices own threads and hardware, and the one of
/// OpenHaptics is known to fail when it is unloaded and loaded again.
class SharedLibrary {
 public:
  /// Loads the first of these files that can be loaded; names without a slash are searched as the dynamic
  /// linker does.
  /// @return what the dynamic linker says of each, joined by "; ", or nothing once one is loaded
  std::string load(const std::vector<std::string>& candidates);

  bool is_loaded() const noexcept { return handle_ != nullptr; }
  const std::string& path() const noexcept { return path_; }  ///< the candidate that was loaded

  /// Fetches a function of the library.
  /// @param function  untouched when the library has none of this name
  /// @return the name where it is missing, or nullptr
  template <class Function>
  const char* find(const char* name, Function*& function) const noexcept {
    void* const address = address_of(name);
    if (address == nullptr) return name;
    function = reinterpret_cast<Function*>(address);
    return nullptr;
  }

 private:
  void* address_of(const char* name) const noexcept;

  void* handle_ = nullptr;
  std::string path_;
};

}  // namespace feeler
