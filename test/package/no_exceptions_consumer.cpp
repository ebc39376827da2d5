// A program without exceptions and run-time types, as many engines are built. It uses the default renderer alone.
bool makes_what_can_be_made();

int main() { return makes_what_can_be_made() ? 0 : 1; }
