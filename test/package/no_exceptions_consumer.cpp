// A program without exceptions and run-time types, as many engines are built.
#include <feeler/feeler.hpp>

int main() {
  const feeler::Settings<double> settings;
  const feeler::Pose<double> pose;
  return settings.margin > 0 && pose.is_finite() ? 0 : 1;
}
