// The usual file names of the makers' libraries, which differ by system.
#pragma once

#include <string>
#include <vector>

namespace feeler {

std::vector<std::string> open_haptics_libraries();     ///< to try in this order
std::vector<std::string> force_dimension_libraries();  ///< to try in this order; libdrd contains all of libdhd
std::vector<std::string> virtuose_libraries();         ///< to try in this order

}  // namespace feeler
