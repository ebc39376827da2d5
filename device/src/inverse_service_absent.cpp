// Stands where the module is built without Boost.Beast or nlohmann's JSON.
#include "inverse_service.hpp"

namespace feeler {

class InverseService::Connection {};

InverseService::InverseService() = default;
InverseService::~InverseService() = default;

std::string InverseService::connect(const std::string&, std::uint16_t, ServiceMessage&) {
  return "Haply: this build of Feeler cannot speak with the Inverse Service: install Boost (1.74 or later) and nlohmann's JSON, and build it with "
         "FEELER_DEVICE_HAPLY=ON.";
}

void InverseService::start(Client&, const std::string&, double) {}

void InverseService::stop() noexcept {}

}  // namespace feeler
