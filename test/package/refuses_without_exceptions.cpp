// A program of which no file has exceptions: a refusal prints its sentence and aborts.
#include <feeler/tool/sphere_swept.hpp>

int main() { [[maybe_unused]] const feeler::Sphere<double> ball(-1.0); }
