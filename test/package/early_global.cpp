// A global whose value asks for something that is refused, before main, and is told so; the file that catches is linked after this one.
bool is_refused();

namespace {
const bool was_refused = is_refused();
}

int main() { return was_refused ? 0 : 1; }
