// A server at the address that the options ask for, and its announcement.
#pragma once

#include <memory>

#include "feeler/viewer/server.hpp"
#include "options.hpp"

namespace feeler::demo {

/// Listens where the options say; where they name no port, at the usual one or any that is free. Others than
/// this machine need a token.
/// @throws BadInput where the address or the port cannot be had
std::unique_ptr<viewer::Server> serve(const Options& options, viewer::ServerSettings settings);

/// Prints the address, and opens it where there is a desktop. Of a server that listens at every address those are printed that others can open.
void announce(const viewer::Server& server, const Options& options, const char* what);

}  // namespace feeler::demo
