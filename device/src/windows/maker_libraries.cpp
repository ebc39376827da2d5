// The names that the makers' libraries have on 64-bit Windows, as CHAI3D and HAPI load them.
#include "feeler/device/maker_libraries.hpp"

namespace feeler {

std::vector<std::string> open_haptics_libraries() { return {"HD.dll"}; }

std::vector<std::string> force_dimension_libraries() { return {"drd64.dll", "dhd64.dll"}; }

std::vector<std::string> virtuose_libraries() { return {"virtuoseAPI.dll", "VirtuoseAPI_x64.dll"}; }

}  // namespace feeler
