#include <parent.hpp>

int main() { return margin_of_parent() > 0 ? 0 : 1; }
