// Asks the loader of Windows.
#include "feeler/device/shared_library.hpp"

#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

namespace feeler {
namespace {

std::string words_of(DWORD error) {
  char text[256] = {};
  DWORD length = FormatMessageA(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS, nullptr, error, 0, text, sizeof text, nullptr);
  while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == '\r' || text[length - 1] == '.')) --length;
  return length > 0 ? std::string(text, length) : "error " + std::to_string(error);
}

}  // namespace

std::string SharedLibrary::load(const std::vector<std::string>& candidates) {
  if (is_loaded()) return {};
  std::string refusals;
  for (const std::string& candidate : candidates) {
    handle_ = LoadLibraryA(candidate.c_str());
    if (handle_ != nullptr) {
      path_ = candidate;
      return {};
    }
    const DWORD error = GetLastError();
    if (!refusals.empty()) refusals += "; ";
    refusals += candidate + ": cannot open shared object file: " + words_of(error);
  }
  return refusals.empty() ? std::string("no file name was given") : refusals;
}

void* SharedLibrary::address_of(const char* name) const noexcept {
  if (handle_ == nullptr) return nullptr;
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(handle_), name));
}

}  // namespace feeler
