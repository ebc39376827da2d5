// The names that the makers' libraries have on Linux.
#include "feeler/device/maker_libraries.hpp"

namespace feeler {

std::vector<std::string> open_haptics_libraries() { return {"libHD.so", "libHD.so.3.4", "libHD.so.3.0"}; }

std::vector<std::string> force_dimension_libraries() {
  return {"libdrd.so", "libdrd.so.3", "libdhd.so", "libdhd.so.3", "/usr/local/lib/libdrd.so.3"};
}

std::vector<std::string> virtuose_libraries() { return {"libvirtuose.so", "libVirtuoseAPI.so"}; }

}  // namespace feeler
