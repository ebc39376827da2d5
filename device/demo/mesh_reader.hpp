// Mesh files of strangers: read in a process of its own, so that whatever one does to a reader, nobody else notices.
#pragma once

#include <stop_token>
#include <string>

#include "mesh_file.hpp"

namespace feeler::demo {

/// The first argument of a program that is to be such a process; the second is the name of the file, which is its input.
constexpr const char* mesh_reader_argument = "--read-a-mesh";

/// Ends within ten seconds of work, or is ended.
/// @return an exit code
int run_mesh_reader(const std::string& name);

/// The mesh of a file. @param stop  ends the reading
/// @throws BadInput with a sentence where there is none, or reading it fails in whatever way
Mesh read_mesh_apart(const std::string& bytes, const std::string& name, const std::stop_token& stop);

}  // namespace feeler::demo
