// The stand-in of the Inverse Service as a program, for tests of programs: writes its address to a file and serves for half a minute at most.
// usage: haply-stand-in file
#include <chrono>
#include <cstdio>
#include <fstream>
#include <thread>

#include "haply_stand_in.hpp"

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return 2;
  const feeler_test::HaplyStandIn service;
  {
    std::ofstream file(arguments[1] + std::string(".part"));
    file << "localhost:" << service.port() << "\n";
  }
  std::rename((arguments[1] + std::string(".part")).c_str(), arguments[1]);
  std::this_thread::sleep_for(std::chrono::seconds(30));
}
