// What goes from one process to the other: counts, vertices and triangles, or a refusal.
#include "mesh_reader.hpp"

#include <sys/resource.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>

#include "bad_input.hpp"
#include "program.hpp"

namespace feeler::demo {
namespace {

constexpr rlim_t most_seconds = 10, most_memory = rlim_t(4) << 30;  // [s], [bytes]

struct Counts {
  std::int64_t vertices, triangles;  // none and none before a refusal
};

std::string read_input() {
  std::string bytes;
  char piece[65536];
  while (const std::size_t size = std::fread(piece, 1, sizeof piece, stdin)) bytes.append(piece, size);
  return bytes;
}

bool write(const void* bytes, std::size_t size) { return std::fwrite(bytes, 1, size, stdout) == size; }

bool write_refusal(const std::string& sentence) {
  constexpr Counts none{0, 0};
  return write(&none, sizeof none) && write(sentence.data(), sentence.size());
}

}  // namespace

int run_mesh_reader(const std::string& name) {
  const rlimit seconds{most_seconds, most_seconds}, memory{most_memory, most_memory}, core{0, 0};
  setrlimit(RLIMIT_CPU, &seconds);
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &core);
  bool is_written = false;
  try {
    const Mesh mesh = read_mesh(read_input(), name);
    const Counts counts{mesh.vertices.rows(), mesh.triangles.rows()};
    is_written = write(&counts, sizeof counts) && write(mesh.vertices.data(), sizeof(double) * std::size_t(mesh.vertices.size())) &&
                 write(mesh.triangles.data(), sizeof(int) * std::size_t(mesh.triangles.size()));
  } catch (const BadInput& refusal) {
    is_written = write_refusal(refusal.what());
  } catch (const std::bad_alloc&) {
    is_written = write_refusal("The file " + name + " takes more than 4 GB of memory to read: reduce its triangles first.");
  }
  return is_written && std::fflush(stdout) == 0 ? 0 : 3;
}

Mesh read_mesh_apart(const std::string& bytes, const std::string& name, const std::stop_token& stop) {
  const std::optional<std::string> answer = filter({"/proc/self/exe", mesh_reader_argument, name}, bytes, stop);
  Counts counts{};
  if (!answer || answer->size() < sizeof counts)
    throw BadInput("The file " + name + " cannot be read: its reader failed, or was not done after ten seconds. Export the mesh again, as STL.");
  std::memcpy(&counts, answer->data(), sizeof counts);
  const char* const content = answer->data() + sizeof counts;
  if (counts.triangles == 0) throw BadInput(std::string(content, answer->size() - sizeof counts));
  Mesh mesh{Points<double>(counts.vertices, 3), Triangles(counts.triangles, 3)};
  const std::size_t vertex_size = sizeof(double) * std::size_t(mesh.vertices.size()),
                    triangle_size = sizeof(int) * std::size_t(mesh.triangles.size());
  if (answer->size() != sizeof counts + vertex_size + triangle_size) throw BadInput("The file " + name + " cannot be read: the disk is full.");
  std::memcpy(mesh.vertices.data(), content, vertex_size);
  std::memcpy(mesh.triangles.data(), content + vertex_size, triangle_size);
  return mesh;
}

}  // namespace feeler::demo
