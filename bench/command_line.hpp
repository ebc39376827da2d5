// How the programs of this folder start and end.
#pragma once

#include <cstdio>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

namespace feeler::bench {

/// Refuses an option that is not a number between two limits, as NaN is not.
template <class Number>
CLI::Validator within(Number least, Number most) {
  std::ostringstream range;
  range << least << " to " << most;
  return {[=, words = range.str()](std::string& text) {
            Number value{};
            const bool is_within = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return is_within ? std::string() : text + " is not a number from " + words;
          },
          "from " + range.str()};
}

/// Reads the options of a program from its command line, then runs it.
/// @return what `run` returns; 0 after --help; 2, with a sentence on the standard error, where an option is refused, `run` throws, or what it printed cannot be written
template <class Run>
int run_with_options(CLI::App& app, int argc, const char* const* argv, const Run& run) {
  constexpr int bad_input = 2;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : bad_input;
  }
  try {
    const int result = run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw std::runtime_error("what was to be printed cannot be written; make room, and run again");
    return result;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), problem.what());
    return bad_input;
  }
}

}  // namespace feeler::bench
