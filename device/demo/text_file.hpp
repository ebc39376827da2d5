// A text file that is complete or says why not.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace feeler::demo {

/// Writes formatted text; `close` tells whether every byte reached the file.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
    if (!file_) fail();
  }

  /// As printf; numbers are written in the C locale.
  template <class... Values>
  void print(const char* format, Values... values) {
    if constexpr (sizeof...(Values) == 0) {
      std::fputs(format, file_.get());
    } else {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-security"
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
      std::fprintf(file_.get(), format, values...);
#pragma GCC diagnostic pop
    }
  }
  void write(const std::string& text) { std::fwrite(text.data(), 1, text.size(), file_.get()); }

  void close() {
    const bool failed = std::ferror(file_.get()) != 0;
    if (std::fclose(file_.release()) != 0 || failed) fail();
  }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  [[noreturn]] void fail() const {
    throw std::runtime_error("The file " + path_.string() + " cannot be written: check the folder and the space left on it.");
  }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace feeler::demo
